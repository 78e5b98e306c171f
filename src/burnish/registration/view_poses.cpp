#include "burnish/registration/view_poses.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "burnish/core/disjoint_sets.h"

namespace burnish {
namespace {

/// The views of the largest set that the constraints which count join; of equal ones the first.
std::vector<bool> largest_set(std::size_t views, const std::vector<PoseConstraint>& constraints,
                              const std::vector<bool>& left_out) {
  DisjointSets sets(views);
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    if (!left_out[i]) sets.unite(constraints[i].target, constraints[i].source);
  }
  std::vector<std::size_t> sizes(views, 0);
  for (std::uint32_t v = 0; v < views; ++v) ++sizes[sets.find(v)];
  const auto largest = std::max_element(sizes.begin(), sizes.end()) - sizes.begin();
  std::vector<bool> inside(views);
  for (std::uint32_t v = 0; v < views; ++v) inside[v] = sets.find(v) == std::uint32_t(largest);
  return inside;
}

/// The pairs that count as constraints.
std::vector<PoseConstraint> constraints_of(const std::vector<RegisteredPair>& pairs,
                                           const PlacementLimits& limits) {
  std::vector<PoseConstraint> constraints;
  for (const auto& [target, source, registration] : pairs) {
    if (!counts_for_poses(registration, limits)) continue;
    constraints.push_back({target, source, registration.T_target_source, registration.information});
  }
  return constraints;
}

/// Per view the middle of what a pair that counts has matched, in the view's axes.
std::vector<Vec3d> middles_of(std::size_t views, const std::vector<RegisteredPair>& pairs,
                              const PlacementLimits& limits) {
  std::vector<Vec3d> middles(views);
  for (auto pair = pairs.rbegin(); pair != pairs.rend(); ++pair) {
    const PairRegistration& registration = pair->registration;
    if (!counts_for_poses(registration, limits)) continue;
    middles[pair->target] = registration.centre;
    middles[pair->source] = registration.T_target_source.inverse()(registration.centre);
  }
  return middles;
}

}  // namespace

std::size_t ViewPoses::placed() const {
  return std::size_t(std::count_if(T_world_view.begin(), T_world_view.end(),
                                   [](const auto& pose) { return pose.has_value(); }));
}

Facts ViewPoses::facts() const {
  const auto accepted = std::count_if(pairs.begin(), pairs.end(), [](const RegisteredPair& pair) {
    return pair.registration.accepted();
  });
  Facts facts{{"views", double(T_world_view.size()), ""},
              {"placed", double(placed()), ""},
              {"pairs", double(pairs.size()), ""},
              {"accepted_pairs", double(accepted), ""}};
  const Facts of_fit = fit.facts();
  facts.insert(facts.end(), of_fit.begin(), of_fit.end());
  return facts;
}

Result<const SurfaceView*> ViewCache::at(std::size_t view, const Context& context) {
  const auto is_it = [view](const auto& entry) { return entry->view == view; };
  auto found = std::find_if(entries_.begin(), entries_.end(), is_it);
  if (found == entries_.end()) {
    Result<SurfaceView> read = source_.read(view, context);
    if (!read) return std::move(read).error();
    if (entries_.size() == capacity_) entries_.erase(entries_.begin());
    entries_.push_back(std::make_unique<Entry>(Entry{view, *std::move(read)}));
  } else {
    std::rotate(found, found + 1, entries_.end());
  }
  return &std::as_const(entries_.back()->pixels);
}

bool counts_for_poses(const PairRegistration& pair, const PlacementLimits& limits) {
  if (!limits.open_directions) return pair.accepted();
  return pair.matched > 0 &&
         std::all_of(pair.refusals.begin(), pair.refusals.end(), [](Refusal refusal) {
           return refusal == Refusal::not_held || refusal == Refusal::not_converged;
         });
}

Result<void> place_views(PoseModel& model, const PlacementLimits& limits, ViewPoses& poses,
                         const Context& context) {
  const std::vector<PoseConstraint> constraints = constraints_of(poses.pairs, limits);
  Result<PoseFit> fit = fit_poses(model, constraints, limits.max_deviation, context);
  if (!fit) return std::move(fit).error();
  poses.fit = *std::move(fit);
  poses.notes.clear();
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    if (!poses.fit.contradicted[i]) continue;
    poses.notes.push_back(
        fmt::format("views {} and {} do not fit what the others say: {:.1f} deviations off",
                    constraints[i].target, constraints[i].source, poses.fit.deviations[i]));
  }
  const std::vector<bool> inside = largest_set(model.views(), constraints, poses.fit.contradicted);
  const std::size_t first =
      std::size_t(std::find(inside.begin(), inside.end(), true) - inside.begin());
  const auto covariances =
      pose_covariances(model, constraints, poses.fit.contradicted, first, context);
  if (!covariances) return covariances.error();
  const std::vector<Vec3d> middles = middles_of(model.views(), poses.pairs, limits);
  poses.T_world_view.assign(model.views(), std::nullopt);
  poses.deviations.assign(model.views(), std::numeric_limits<double>::infinity());
  for (std::size_t view = 0; view < model.views(); ++view) {
    if (!inside[view]) {
      poses.notes.push_back(fmt::format("view {}: no pair joins it to the others", view));
      continue;
    }
    const Vec3d seen = (model.pose(first).inverse() * model.pose(view))(middles[view]);
    const double deviation = deviation_at((*covariances)[view], seen);
    if (deviation > limits.max_uncertainty) {
      poses.notes.push_back(
          fmt::format("view {}: what it sees is known to {:.1f} mm, {:.1f} mm are needed", view,
                      1000 * deviation, 1000 * limits.max_uncertainty));
      continue;
    }
    poses.deviations[view] = deviation;
    poses.T_world_view[view] = model.pose(view);
  }
  return {};
}

}  // namespace burnish
