#include "burnish/registration/turntable_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "burnish/registration/twist.h"

namespace burnish {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// A line in the camera's axes, and which way the table turns about it.
struct Axis {
  Vec3d point;      ///< the one nearest to the middle of what is seen
  Vec3d direction;  ///< unit length, to the top of the image

  /// Where the camera of a view stands in the first one's axes once the table has turned.
  RigidTransform turned(double angle) const {
    RigidTransform T = rotation_by(direction * angle);
    T.translation = point - T.rotate(point);
    return T;
  }

  /// The axis becomes the world's z, its point the origin.
  RigidTransform T_world_camera() const {
    const Vec3d towards_camera = -point - direction * dot(-point, direction);
    const Vec3d x = normalized(towards_camera);
    RigidTransform T{{x, cross(direction, x), direction}, {}};
    T.translation = -T.rotate(point);
    return T;
  }
};

/// The middle of what a view sees and how far it reaches to the side.
struct Extent {
  Vec3d middle;
  double radius = 0;
  std::size_t count = 0;
};

Extent extent_of(const SurfaceView& view) {
  Vec3d low{1e300, 1e300, 1e300}, high = -low;
  Extent extent;
  for (const SurfacePixel& pixel : view.pixels) {
    if (pixel.position.z == 0) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], double{pixel.position[i]});
      high[i] = std::max(high[i], double{pixel.position[i]});
    }
    ++extent.count;
  }
  if (extent.count == 0) return extent;
  extent.middle = (low + high) * 0.5;
  extent.radius = (high.x - low.x) / 2;
  return extent;
}

/// Where axes can be that a camera looks at from above by `elevation`: it sees the near half of
/// what turns about them.
Axis likely_axis(const Extent& seen, double elevation) {
  const Vec3d up{0, -std::cos(elevation), -std::sin(elevation)};
  const Vec3d behind{0, -std::sin(elevation), std::cos(elevation)};
  return {seen.middle + behind * (seen.radius / 2), up};
}

/// The axis about which a registered step turns, and by how much.
struct Turn {
  Axis axis;
  double angle = 0;
};

Turn turn_of(const RigidTransform& T, const Vec3d& middle) {
  const Vec3d v = rotation_vector(T);
  const double size = norm(v);
  Vec3d direction = v / size;
  const double sign = direction.y > 0 ? -1 : 1;  // y points down in images
  // The point p with R p + t = p, on the plane through the origin across the axis.
  const Vec3d across = T.translation - direction * dot(T.translation, direction);
  const Vec3d p = (across + cross(direction, across) / std::tan(size / 2)) * 0.5;
  direction *= sign;
  return {{p + direction * dot(middle - p, direction), direction}, sign * size};
}

/// How many views apart those are that are laid on each other, in this order: neighbours, then
/// those farther apart as long as they share enough of what they see, then once more neighbours
/// that were refused when the axis was not well known.
std::vector<std::size_t> rings_of(std::size_t views, double step) {
  constexpr double kFarthest = 50 * kDegree;
  std::vector<std::size_t> rings{1};
  for (std::size_t apart = 2; 2 * apart < views && double(apart) * step <= kFarthest; ++apart) {
    rings.push_back(apart);
  }
  rings.push_back(1);
  return rings;
}

/// Lays views on each other one pair at a time, and remembers what came of it.
class Turntable {
 public:
  Turntable(const ViewSource& views, const TurntableViewsParams& params, ViewPoses& poses)
      : cache_(views, 4),
        count_(views.count),
        params_(params),
        limits_{params.max_deviation, params.pairs.acceptance.max_deviation, true},
        poses_(poses) {
    step_ = params.step > 0 ? params.step : 2 * std::numbers::pi / double(count_);
  }

  /// The axis by the first pair of neighbours that says where it is; none where none does.
  Result<std::optional<Turn>> find_axis(const Context& context) {
    constexpr std::size_t kMostPairs = 6;
    const std::size_t pairs = std::min(count_ - 1, kMostPairs);
    for (std::size_t i = 0; i < pairs; ++i) {
      Result<std::optional<Turn>> turn =
          axis_from(i, context.part(double(i) / double(pairs), double(i + 1) / double(pairs)));
      if (!turn || *turn) return turn;
    }
    return std::optional<Turn>{};
  }

  /// Lays every view on the one `apart` views later, from where `model` says that they are.
  Result<void> register_ring(const TurntablePoses& model, std::size_t apart,
                             const Context& context) {
    const std::size_t pairs = params_.closed ? count_ : count_ - apart;
    for (std::size_t i = 0; i < pairs; ++i) {
      const std::size_t next = (i + apart) % count_;
      if (counts(i, next)) continue;
      const RigidTransform guess = model.pose(i).inverse() * model.pose(next);
      auto pair = lay(i, next, guess,
                      context.part(double(i) / double(pairs), double(i + 1) / double(pairs)));
      if (!pair) return pair.error();
      remember(i, next, *std::move(pair));
    }
    return {};
  }

  double step() const { return step_; }
  const PlacementLimits& limits() const { return limits_; }

 private:
  Result<std::optional<Turn>> axis_from(std::size_t first, const Context& context) {
    Result<const SurfaceView*> view = cache_.at(first, context);
    if (!view) return std::move(view).error();
    const Extent seen = extent_of(**view);
    std::optional<Turn> best;
    std::size_t most = 0;
    if (seen.count == 0) return best;
    Context quiet = context;
    quiet.sink = nullptr;
    constexpr int kTilts = 6;
    for (int i = 0; i < 2 * kTilts; ++i) {
      const double elevation = 15 * kDegree * (i / 2), angle = i % 2 == 0 ? step_ : -step_;
      const auto pair = lay(first, first + 1, likely_axis(seen, elevation).turned(angle), quiet);
      if (!pair) return pair.error();
      const bool turns = norm(rotation_vector(pair->T_target_source)) > step_ / 2;
      if (!pair->accepted() || !turns || pair->matched <= most) continue;
      most = pair->matched;
      best = turn_of(pair->T_target_source, seen.middle);
    }
    context.progress(1);
    return best;
  }

  Result<PairRegistration> lay(std::size_t target, std::size_t source, const RigidTransform& guess,
                               const Context& context) {
    const auto target_view = cache_.at(target, context);
    if (!target_view) return target_view.error();
    const auto source_view = cache_.at(source, context);
    if (!source_view) return source_view.error();
    return register_projective(**source_view, **target_view, guess, params_.pairs, context);
  }

  bool counts(std::size_t target, std::size_t source) const {
    return std::any_of(poses_.pairs.begin(), poses_.pairs.end(), [&](const RegisteredPair& pair) {
      return pair.target == target && pair.source == source &&
             counts_for_poses(pair.registration, limits_);
    });
  }

  /// The last word on a pair counts.
  void remember(std::size_t target, std::size_t source, PairRegistration registration) {
    std::erase_if(poses_.pairs, [&](const RegisteredPair& pair) {
      return pair.target == target && pair.source == source;
    });
    poses_.pairs.push_back({std::uint32_t(target), std::uint32_t(source), std::move(registration)});
  }

  ViewCache cache_;
  std::size_t count_;
  const TurntableViewsParams& params_;
  PlacementLimits limits_;
  ViewPoses& poses_;
  double step_;
};

}  // namespace

const Schema<TurntableViewsParams>& TurntableViewsParams::schema() {
  using P = TurntableViewsParams;
  static const auto schema =
      Schema<P>()
          .real("step", &P::step, between(0, std::numbers::pi),
                "of the table from view to view; 0: a full turn by the number of views",
                Quantity::angle)
          .flag("closed", &P::closed, "the first view follows the last")
          .real("max_deviation", &P::max_deviation, more_than(0),
                "a pair farther from what the others say, in standard deviations, is left out");
  return schema;
}

ProjectiveParams TurntableViewsParams::near_pairs() {
  ProjectiveParams params;
  params.reach = 0.05;
  return params;
}

Facts TurntableViews::facts() const {
  Facts facts = poses.facts();
  facts.push_back({"axis_elevation", axis_elevation, "rad"});
  return facts;
}

Result<TurntableViews> register_turntable(const ViewSource& views,
                                          const TurntableViewsParams& params,
                                          const Context& context) {
  if (auto valid = TurntableViewsParams::schema().check(params); !valid) return valid.error();
  if (views.count < 2) {
    return Error{ErrorCode::invalid_argument,
                 fmt::format("{} views were given, two at least were expected", views.count),
                 {}};
  }
  TurntableViews result;
  result.poses.T_world_view.resize(views.count);
  Turntable table(views, params, result.poses);
  const Result<std::optional<Turn>> first = table.find_axis(context.part(0, 0.2));
  if (!first) return first.error();
  if (!*first) {
    result.poses.notes.push_back(
        "no two views that follow each other show where the table's axis is");
    return result;
  }
  std::vector<double> angles(views.count);
  const double step = (*first)->angle > 0 ? table.step() : -table.step();
  for (std::size_t i = 0; i < angles.size(); ++i) angles[i] = step * double(i);
  TurntablePoses model((*first)->axis.T_world_camera(), std::move(angles));

  const std::vector<std::size_t> rings = rings_of(views.count, table.step());
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const auto share = [&](std::size_t k) { return 0.2 + 0.8 * double(k) / double(rings.size()); };
    if (auto done = table.register_ring(model, rings[i], context.part(share(i), share(i + 1)));
        !done) {
      return done.error();
    }
    if (auto done = place_views(model, table.limits(), result.poses, context); !done) {
      return done.error();
    }
  }
  result.angles = model.angles();
  const Vec3d forward = model.T_world_camera().rotate({0, 0, 1});
  result.axis_elevation = std::asin(std::clamp(-forward.z, -1., 1.));
  context.progress(1);
  return result;
}

}  // namespace burnish
