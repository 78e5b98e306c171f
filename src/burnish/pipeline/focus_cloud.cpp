#include "burnish/pipeline/focus_cloud.h"

#include <algorithm>
#include <chrono>
#include <limits>

#include "burnish/pipeline/selection.h"
#include "burnish/triangulation/fan_thinning.h"

namespace burnish {
namespace {

/// Per point whether it is inside; a missing pixel is not.
std::vector<std::uint8_t> inside_of(const PointCloud& cloud,
                                    const std::function<bool(const Vec3d&)>& where) {
  std::vector<std::uint8_t> inside;
  inside.reserve(cloud.positions.size());
  for (const Vec3f& p : cloud.positions) {
    inside.push_back(is_finite(p) && where(cloud.frame.origin + Vec3d(p)));
  }
  return inside;
}

}  // namespace

Result<void> focus_cloud(PointCloud& cloud, const std::string& region, std::size_t outside_points,
                         Record& record, const Context& context) {
  const auto start = std::chrono::steady_clock::now();
  context.stage("adapting");
  const auto where = read_selection(region, context.part(0, 0.1));
  if (!where) return where.error();
  const std::vector<std::uint8_t> inside = inside_of(cloud, *where);
  const auto kept = std::count(inside.begin(), inside.end(), 1);
  if (kept == 0) {
    return Error{ErrorCode::invalid_argument, "no point lies in '" + region + "'", {}};
  }
  FanThinningParams params;
  constexpr std::size_t kMost = std::numeric_limits<int>::max();
  params.target_points = static_cast<int>(std::min(outside_points, kMost));
  const auto report = thin_by_fans(
      cloud, [&inside](std::uint32_t p) { return inside[p] == 0; }, params, context.part(0.1, 1));
  if (!report) return report.error();

  const auto& schema = FanThinningParams::schema();
  Settings settings = schema.settings(params);
  std::vector<FieldInfo> fields = schema.fields();
  settings.emplace_back("region", region);
  fields.push_back({"region", "region", "", "", "", "where all points stay"});
  Facts facts = report->facts();
  facts.push_back({"points_inside", static_cast<double>(kept), ""});
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  record.steps.push_back(
      {"adapt", "fan_cloud", std::move(settings), std::move(facts), seconds.count(), fields});
  return {};
}

}  // namespace burnish
