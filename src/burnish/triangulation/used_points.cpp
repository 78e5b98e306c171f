#include "burnish/triangulation/used_points.h"

#include <limits>

#include "burnish/core/gather.h"

namespace burnish {

Triangulation mesh_of_used_points(const PointCloud& cloud, std::vector<Triangle> triangles) {
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(cloud.positions.size(), kUnused);
  for (const Triangle& t : triangles) {
    for (const std::uint32_t v : t) number[v] = 0;
  }
  Triangulation result;
  std::vector<std::uint32_t> used;
  for (std::uint32_t v = 0; v < number.size(); ++v) {
    result.report.points += is_finite(cloud.positions[v]);
    if (number[v] == kUnused) continue;
    number[v] = static_cast<std::uint32_t>(used.size());
    used.push_back(v);
  }
  for (Triangle& t : triangles) t = {number[t[0]], number[t[1]], number[t[2]]};
  result.report.missing_points = cloud.positions.size() - result.report.points;
  result.report.unused_points = result.report.points - used.size();
  result.report.triangles = triangles.size();
  result.mesh = {gather(cloud.positions, used), std::move(triangles),
                 gather(cloud.attributes, used), cloud.frame};
  return result;
}

}  // namespace burnish
