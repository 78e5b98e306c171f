#include "burnish/triangulation/adaptive_fan_cloud.h"

#include <fmt/format.h>

#include <algorithm>

#include "burnish/base/parallel.h"
#include "burnish/triangulation/index_heap.h"

namespace burnish {
namespace {

/// One edit takes as long as the fans of so many points take when all are built at once.
constexpr std::size_t kEdit = 16;
/// Edits between two looks at the clock: a few milliseconds.
constexpr std::size_t kEditsAtOnce = 64;

/// The median of the fans' mean edges; 1 where there are no fans.
double usual_fan_edge(const FanCloud& fans) {
  std::vector<double> edges;
  for (std::uint32_t p = 0; p < fans.size(); ++p) {
    if (const double edge = mean_fan_edge(fans, p); edge > 0) edges.push_back(edge);
  }
  if (edges.empty()) return 1;
  const auto middle = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2);
  std::nth_element(edges.begin(), middle, edges.end());
  return *middle;
}

/// Tells how far a loop of edits is; false where it was cancelled.
[[nodiscard]] bool go_on(const Context& context, std::size_t done, std::size_t all) {
  if (done % kEditsAtOnce != 0) return true;
  if (context.cancelled()) return false;
  context.progress(static_cast<double>(done) / static_cast<double>(all));
  return true;
}

}  // namespace

Result<AdaptiveFanCloud> AdaptiveFanCloud::build(PointCloud cloud,
                                                 const AdaptiveFanCloudParams& params,
                                                 const Context& context) {
  if (auto valid = InformationWeights::schema().check(params.weights); !valid) {
    return valid.error();
  }
  if (auto sound = check(cloud); !sound) return sound.error();
  if (cloud.grid) cloud = without_missing(cloud);
  Result<FanCloud> fans =
      FanCloud::build(cloud.positions, cloud.attributes.normals, params.fans, context);
  if (!fans) return std::move(fans).error();

  AdaptiveFanCloud result(*std::move(fans));
  result.params_ = params;
  result.rest_ = std::move(cloud);
  result.rest_.positions = {};
  result.normals_ = std::exchange(result.rest_.attributes.normals, {});
  result.take_normals_of_fans();
  result.usual_edge_ = usual_fan_edge(result.fans_);
  result.around_.resize(result.size());
  result.details_.resize(result.size());
  return result;
}

/// For the active points of which no normal is given.
void AdaptiveFanCloud::take_normals_of_fans() {
  normals_.resize(size());
  const std::span<const Vec3f> given = fans_.normals();
  for (std::uint32_t p = 0; p < size(); ++p) {
    const bool unknown = given.empty() || given[p] == Vec3f{};
    if (fans_.active(p) && unknown) normals_[p] = fans_.fan_normal(p);
  }
}

PointInformation AdaptiveFanCloud::information() const {
  return {params_.weights, usual_edge_, normals_, rest_.attributes};
}

std::vector<std::uint32_t> AdaptiveFanCloud::active_points() const {
  std::vector<std::uint32_t> points;
  points.reserve(active_count());
  for (std::uint32_t p = 0; p < size(); ++p) {
    if (fans_.active(p)) points.push_back(p);
  }
  return points;
}

PointCloud AdaptiveFanCloud::active_cloud() const {
  const std::vector<std::uint32_t> active = active_points();
  PointCloud cloud;
  cloud.attributes = gather(rest_.attributes, active);
  for (const std::uint32_t p : active) {
    cloud.positions.push_back(fans_.positions()[p]);
    if (!fans_.normals().empty()) cloud.attributes.normals.push_back(fans_.normals()[p]);
  }
  cloud.viewpoint = rest_.viewpoint;
  cloud.frame = rest_.frame;
  return cloud;
}

Result<void> AdaptiveFanCloud::to_points(std::size_t count, const Context& context) {
  if (count < active_count()) return reduce_among(active_points(), count, context);
  const std::size_t returning = std::min(count, size()) - active_count();
  std::vector<std::uint32_t> points;
  for (std::size_t i = 0; i < returning; ++i) points.push_back(log_[log_.size() - 1 - i].point);
  return bring_back(points, context);
}

Result<void> AdaptiveFanCloud::reduce(const PointSelection& selection, std::size_t count,
                                      const Context& context) {
  std::vector<std::uint32_t> candidates = active_points();
  std::erase_if(candidates, [&](std::uint32_t p) { return !selection(p); });
  return reduce_among(std::move(candidates), count, context);
}

Result<void> AdaptiveFanCloud::refine(const PointSelection& selection, std::size_t count,
                                      const Context& context) {
  std::size_t active = 0;
  std::vector<std::uint8_t> selected(size());
  for (std::uint32_t p = 0; p < size(); ++p) {
    selected[p] = selection(p);
    active += selected[p] && fans_.active(p);
  }
  std::vector<std::uint32_t> points;
  for (std::size_t i = log_.size(); i-- > 0 && active + points.size() < count;) {
    if (selected[log_[i].point]) points.push_back(log_[i].point);
  }
  return bring_back(points, context);
}

Result<void> AdaptiveFanCloud::reduce_among(std::vector<std::uint32_t> candidates,
                                            std::size_t count, const Context& context) {
  const PointInformation information_of = information();
  std::vector<IndexHeap::Item> items(candidates.size());
  const bool complete =
      parallel_for(context.part(0, 0.02), candidates.size(), [&](IndexRange range) {
        for (std::size_t i = range.begin; i < range.end; ++i) {
          items[i] = {information_of(fans_, candidates[i]), candidates[i]};
        }
      });
  if (!complete) return cancelled();
  IndexHeap heap(std::move(items), size());
  const Context edits = context.part(0.02, 1);
  const std::size_t removals = heap.size() - std::min(count, heap.size());
  for (std::size_t done = 0; done < removals; ++done) {
    if (!go_on(edits, done, removals)) return cancelled();
    const IndexHeap::Item least = heap.pop();
    remove(least.index, least.value);
    for (const std::uint32_t p : fans_.renewed()) {
      if (heap.contains(p)) heap.change(p, information_of(fans_, p));
    }
  }
  edits.progress(1);
  return {};
}

/// Its detail is measured in the frame of its rim or, where it has none, from the nearest point.
void AdaptiveFanCloud::remove(std::uint32_t p, double information) {
  ring_.assign(fans_.rim(p).begin(), fans_.rim(p).end());
  std::erase(ring_, Fan::kGap);
  static_cast<void>(fans_.set_active(p, false));
  log_.push_back({p, information});
  if (ring_.empty()) {
    fans_.nearest(fans_.positions()[p], 1, nearest_);
    for (const Neighbour& q : nearest_) ring_.push_back(q.index);
  }
  order_for_detail(fans_.positions(), ring_);
  around_.assign(p, ring_);
  details_[p] = detail_of(fans_.positions()[p], normals_[p], fans_.positions(), ring_);
}

/// In the order of `points`.
Result<void> AdaptiveFanCloud::bring_back(const std::vector<std::uint32_t>& points,
                                          const Context& context) {
  bool complete = true;
  if (points.size() * kEdit > active_count() + points.size()) {
    Result<FanCloud> fans = rebuilt(fans_.positions(), fans_.normals(), points, context);
    if (!fans) return std::move(fans).error();
    fans_ = *std::move(fans);
  } else {
    for (std::size_t i = 0; i < points.size() && complete; ++i) {
      complete = go_on(context, i, points.size());
      if (complete) static_cast<void>(fans_.set_active(points[i], true));
    }
  }
  std::erase_if(log_, [this](const Removal& removal) { return fans_.active(removal.point); });
  if (!complete) return cancelled();
  context.progress(1);
  return {};
}

Result<FanCloud> AdaptiveFanCloud::rebuilt(std::span<const Vec3f> positions,
                                           std::span<const Vec3f> normals,
                                           const std::vector<std::uint32_t>& returning,
                                           const Context& context) const {
  std::vector<std::uint8_t> active(size());
  for (std::uint32_t p = 0; p < size(); ++p) active[p] = fans_.active(p);
  for (const std::uint32_t p : returning) active[p] = 1;
  return FanCloud::build(positions, normals, params_.fans, context, active);
}

Result<void> AdaptiveFanCloud::set_positions(std::span<const Vec3f> positions, WayBack way,
                                             std::span<const Vec3f> normals,
                                             const Context& context) {
  if (positions.size() != active_count() ||
      (!normals.empty() && normals.size() != active_count())) {
    return Error{ErrorCode::invalid_argument,
                 fmt::format("{} positions and {} normals for {} active points", positions.size(),
                             normals.size(), active_count()),
                 {}};
  }
  if (!normals.empty() && fans_.normals().empty()) {
    return Error{ErrorCode::invalid_argument, "normals for a cloud that has none", {}};
  }
  std::vector<Vec3f> all(fans_.positions().begin(), fans_.positions().end());
  std::vector<Vec3f> given(fans_.normals().begin(), fans_.normals().end()), measured = normals_;
  const std::vector<std::uint32_t> active = active_points();
  for (std::size_t i = 0; i < active.size(); ++i) {
    all[active[i]] = positions[i];
    if (!normals.empty()) given[active[i]] = measured[active[i]] = normals[i];
  }
  if (way == WayBack::detail) {
    for (auto removal = log_.rbegin(); removal != log_.rend(); ++removal) {
      const std::uint32_t p = removal->point;
      place_detail(details_[p], all, around_.row(p), all[p], measured[p]);
      if (!given.empty() && given[p] != Vec3f{}) given[p] = measured[p];
    }
  }
  Result<FanCloud> fans = rebuilt(all, given, {}, context);
  if (!fans) return std::move(fans).error();
  fans_ = *std::move(fans);
  normals_ = std::move(measured);
  take_normals_of_fans();
  return {};
}

}  // namespace burnish
