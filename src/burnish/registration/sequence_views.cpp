#include "burnish/registration/sequence_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "burnish/registration/global_start.h"

namespace burnish {
namespace {

/// A few of a view's points, to see what others have in view of them.
using Glimpse = std::vector<Vec3d>;

Glimpse glimpse_of(const SurfaceView& view) {
  constexpr std::size_t kEvery = 41;  // in both directions
  Glimpse points;
  for (std::size_t row = kEvery / 2; row < view.camera.height; row += kEvery) {
    for (std::size_t column = kEvery / 2; column < view.camera.width; column += kEvery) {
      const SurfacePixel& pixel = view.pixels[row * view.camera.width + column];
      if (pixel.position.z > 0) points.push_back(Vec3d(pixel.position));
    }
  }
  return points;
}

/// The share of the points that are in the camera's image, at T of where they were taken.
double share_in_view(const Glimpse& points, const RigidTransform& T, const Camera& camera) {
  std::size_t inside = 0;
  for (const Vec3d& point : points) {
    const Vec3d p = T(point);
    if (p.z <= 0) continue;
    const Vec3d pixel = camera.project(p);
    inside += pixel.x >= 0 && pixel.y >= 0 && pixel.x < camera.width && pixel.y < camera.height;
  }
  return points.empty() ? 0 : double(inside) / double(points.size());
}

/// Lays one view after the other on what came before.
class Sequence {
 public:
  Sequence(const ViewSource& views, const SequenceViewsParams& params, ViewPoses& poses)
      : cache_(views, std::size_t(params.recalled) + 4),
        params_(params),
        poses_(poses),
        T_world_view_(views.count) {}

  Result<void> begin(const Context& context) {
    const auto view = cache_.at(0, context);
    if (!view) return view.error();
    make_key(0, **view);
    return {};
  }

  /// Finds where view `i` was taken from.
  Result<void> track(std::uint32_t i, const Context& context) {
    const std::uint32_t last = i - 1;
    const RigidTransform moved_on =
        i >= 2 ? T_world_view_[last] * T_world_view_[i - 2].inverse() * T_world_view_[last]
               : T_world_view_[last];
    const std::uint32_t key = keys_.back().view;
    std::vector<Trial> trials{{key, moved_on}, {key, T_world_view_[last]}};
    if (last != key) trials.push_back({last, T_world_view_[last]});
    const std::size_t recalled = std::min(keys_.size() - 1, std::size_t(params_.recalled));
    for (std::size_t k = 0; k < recalled; ++k) {
      const std::uint32_t earlier = keys_[keys_.size() - 2 - k].view;
      trials.push_back({earlier, T_world_view_[last]});
      trials.push_back({earlier, T_world_view_[earlier]});
    }
    trials.push_back({key, std::nullopt});
    std::optional<RegisteredPair> nearest;  // of the refused: it says what is against view i
    for (const Trial& trial : trials) {
      auto pair = lay(trial, i, context);
      if (!pair) return pair.error();
      if (pair->accepted()) return place(i, trial.target, *std::move(pair), context);
      if (nearest && pair->matched <= nearest->registration.matched) continue;
      nearest = {trial.target, i, *std::move(pair)};
    }
    poses_.pairs.push_back(*std::move(nearest));
    T_world_view_[i] = moved_on;
    return add_key(i, context);
  }

  /// Lays key views on each other that should see the same.
  Result<void> close_loops(const Context& context) {
    constexpr double kShared = 0.3;
    for (std::size_t b = 1; b < keys_.size(); ++b) {
      for (std::size_t a = 0; a < b; ++a) {
        const std::uint32_t target = keys_[a].view, source = keys_[b].view;
        const RigidTransform guess = T_world_view_[target].inverse() * T_world_view_[source];
        const double shared =
            std::min(share_in_view(keys_[b].glimpse, guess, keys_[a].camera),
                     share_in_view(keys_[a].glimpse, guess.inverse(), keys_[b].camera));
        if (shared < kShared || is_laid(target, source)) continue;
        auto pair = lay(target, source, guess, context);
        if (!pair) return pair.error();
        poses_.pairs.push_back({target, source, *std::move(pair)});
      }
      context.progress(double(b) / double(keys_.size()));
    }
    return {};
  }

  const std::vector<RigidTransform>& T_world_view() const { return T_world_view_; }
  void set_poses(const PoseModel& model) {
    for (std::size_t i = 0; i < T_world_view_.size(); ++i) T_world_view_[i] = model.pose(i);
  }

 private:
  struct Trial {
    std::uint32_t target;
    std::optional<RigidTransform> T_world_view;  ///< where the view may be; none: anywhere
  };
  struct Key {
    std::uint32_t view;
    Camera camera;
    Glimpse glimpse;
  };

  /// View `i` is where an accepted pair has it.
  Result<void> place(std::uint32_t i, std::uint32_t target, PairRegistration pair,
                     const Context& context) {
    T_world_view_[i] = T_world_view_[target] * pair.T_target_source;
    const bool far = target != keys_.back().view || pair.overlap < params_.key_overlap;
    poses_.pairs.push_back({target, i, std::move(pair)});
    return far ? add_key(i, context) : Result<void>();
  }

  Result<void> add_key(std::uint32_t i, const Context& context) {
    const auto view = cache_.at(i, context);
    if (!view) return view.error();
    make_key(i, **view);
    return {};
  }

  void make_key(std::uint32_t i, const SurfaceView& view) {
    keys_.push_back({i, view.camera, glimpse_of(view)});
  }

  Result<PairRegistration> lay(const Trial& trial, std::uint32_t source, const Context& context) {
    if (trial.T_world_view) {
      const RigidTransform T_target_world = T_world_view_[trial.target].inverse();
      return lay(trial.target, source, T_target_world * *trial.T_world_view, context);
    }
    return with_both(trial.target, source, context,
                     [&](const SurfaceView& to, const SurfaceView& from, const Context& quiet) {
                       return register_views_globally(from, to, {}, params_.pairs, quiet);
                     });
  }

  Result<PairRegistration> lay(std::uint32_t target, std::uint32_t source,
                               const RigidTransform& guess, const Context& context) {
    return with_both(target, source, context,
                     [&](const SurfaceView& to, const SurfaceView& from, const Context& quiet) {
                       return register_projective(from, to, guess, params_.pairs, quiet);
                     });
  }

  template <class Lay>
  Result<PairRegistration> with_both(std::uint32_t target, std::uint32_t source,
                                     const Context& context, Lay lay) {
    Context quiet = context;
    quiet.sink = nullptr;
    const auto target_view = cache_.at(target, quiet);
    if (!target_view) return target_view.error();
    const auto source_view = cache_.at(source, quiet);
    if (!source_view) return source_view.error();
    return lay(**target_view, **source_view, quiet);
  }

  bool is_laid(std::uint32_t target, std::uint32_t source) const {
    return std::any_of(poses_.pairs.begin(), poses_.pairs.end(), [&](const RegisteredPair& pair) {
      return pair.target == target && pair.source == source;
    });
  }

  ViewCache cache_;
  const SequenceViewsParams& params_;
  ViewPoses& poses_;
  std::vector<RigidTransform> T_world_view_;  ///< as far as is known so far
  std::vector<Key> keys_;
};

}  // namespace

const Schema<SequenceViewsParams>& SequenceViewsParams::schema() {
  using P = SequenceViewsParams;
  static const auto schema =
      Schema<P>()
          .real("key_overlap", &P::key_overlap, between(0, 1),
                "a view that shares less with its key view becomes one itself")
          .integer("recalled", &P::recalled, between(0, 100),
                   "key views that one which fits nowhere is tried on")
          .real("max_deviation", &P::max_deviation, more_than(0),
                "a pair farther from what the others say, in standard deviations, is left out");
  return schema;
}

Result<ViewPoses> register_sequence(const ViewSource& views, const SequenceViewsParams& params,
                                    const Context& context) {
  if (auto valid = SequenceViewsParams::schema().check(params); !valid) return valid.error();
  if (views.count < 2) {
    return Error{ErrorCode::invalid_argument,
                 fmt::format("{} views were given, two at least were expected", views.count),
                 {}};
  }
  ViewPoses result;
  Sequence sequence(views, params, result);
  if (auto begun = sequence.begin(context); !begun) return begun.error();
  for (std::uint32_t i = 1; i < views.count; ++i) {
    if (context.cancelled()) return cancelled();
    context.progress(0.8 * double(i) / double(views.count));
    if (auto done = sequence.track(i, context); !done) return done.error();
  }
  const PlacementLimits limits{.max_deviation = params.max_deviation};
  // Loops are looked for where the poses say they are: once more when some have been closed.
  for (const double end : {0.9, 1.0}) {
    FreePoses model(sequence.T_world_view());
    if (auto done = place_views(model, limits, result, context); !done) return done.error();
    sequence.set_poses(model);
    if (auto done = sequence.close_loops(context.part(end - 0.1, end)); !done) return done.error();
  }
  FreePoses model(sequence.T_world_view());
  if (auto done = place_views(model, limits, result, context); !done) return done.error();
  context.progress(1);
  return result;
}

}  // namespace burnish
