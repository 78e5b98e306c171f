#include "burnish/triangulation/fan_thinning.h"

#include <algorithm>
#include <cmath>

#include "burnish/triangulation/point_order.h"

namespace burnish {
namespace {

/// At least one, so that a cloud stays one.
std::size_t target_of(const FanThinningParams& params, std::size_t points) {
  const double ratio = params.ratio == 0 && params.target_points == 0 ? 0.5 : params.ratio;
  const auto share = static_cast<std::size_t>(std::llround(ratio * static_cast<double>(points)));
  const std::size_t target = std::max(static_cast<std::size_t>(params.target_points), share);
  return std::clamp<std::size_t>(target, 1, std::max<std::size_t>(points, 1));
}

/// The points along a space-filling curve, then those in the place of another: an order that keeps
/// neighbours close in memory and that, coincident points aside, depends on places alone.
std::vector<std::uint32_t> order_of(const std::vector<Vec3f>& positions) {
  std::vector<std::uint32_t> order = order_along_curve(positions);
  std::vector<std::uint8_t> taken(positions.size());
  for (const std::uint32_t p : order) taken[p] = 1;
  for (std::uint32_t p = 0; p < positions.size(); ++p) {
    if (!taken[p] && is_finite(positions[p])) order.push_back(p);
  }
  return order;
}

}  // namespace

const Schema<FanThinningParams>& FanThinningParams::schema() {
  using P = FanThinningParams;
  static const auto schema =
      Schema<P>()
          .integer("target_points", &P::target_points, at_least(0),
                   "stop at so many points; 0: no such target")
          .real("ratio", &P::ratio, between(0, 1),
                "stop at this share of the points; 0: half of them where nothing else is set")
          .group(&P::weights, InformationWeights::schema());
  return schema;
}

Facts FanThinningReport::facts() const {
  return {{"points_before", static_cast<double>(points_before), ""},
          {"points", static_cast<double>(points), ""},
          {"least_information", least_information, ""},
          {"largest_information", largest_information, ""}};
}

Result<FanThinningReport> thin_by_fans(PointCloud& cloud, const FanThinningParams& params,
                                       const Context& context) {
  return thin_by_fans(
      cloud, [](std::uint32_t) { return true; }, params, context);
}

Result<FanThinningReport> thin_by_fans(PointCloud& cloud, const PointSelection& where,
                                       const FanThinningParams& params, const Context& context) {
  if (auto valid = FanThinningParams::schema().check(params); !valid) return valid.error();
  if (auto sound = check(cloud); !sound) return sound.error();
  const std::vector<std::uint32_t> order = order_of(cloud.positions);
  context.stage("building fans");
  auto fans =
      AdaptiveFanCloud::build(select(cloud, order), {{}, params.weights}, context.part(0, 0.1));
  if (!fans) return std::move(fans).error();
  context.stage("removing points");
  const auto selected = [&](std::uint32_t i) { return where(order[i]); };
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < order.size(); ++i) count += selected(i);
  const std::size_t target = target_of(params, count);
  if (auto done = fans->reduce(selected, target, context.part(0.1, 0.98)); !done) {
    return done.error();
  }

  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    if (fans->fans().active(i)) kept.push_back(order[i]);
  }
  std::sort(kept.begin(), kept.end());
  PointCloud thinned = select(cloud, kept);
  if (context.cancelled()) return cancelled();
  FanThinningReport report{order.size(), kept.size(), 0, 0};
  if (!fans->log().empty()) {
    const auto [least, largest] = std::minmax_element(
        fans->log().begin(), fans->log().end(),
        [](const auto& a, const auto& b) { return a.information < b.information; });
    report.least_information = least->information;
    report.largest_information = largest->information;
  }
  cloud = std::move(thinned);
  context.progress(1);
  return report;
}

}  // namespace burnish
