#include "burnish/triangulation/used_points.h"

#include <algorithm>

#include "burnish/core/gather.h"

namespace burnish {

Triangulation mesh_of(const PointCloud& cloud, const UsedPoints& used,
                      std::vector<Triangle> triangles) {
  Triangulation result;
  result.report.points = static_cast<std::size_t>(
      std::count_if(cloud.positions.begin(), cloud.positions.end(), is_finite<float>));
  result.report.missing_points = cloud.positions.size() - result.report.points;
  result.report.unused_points = result.report.points - used.points.size();
  result.report.triangles = triangles.size();
  const Selection selected(used.points);
  result.mesh = {selected.of(cloud.positions), std::move(triangles),
                 gather(cloud.attributes, selected), cloud.frame};
  return result;
}

Triangulation mesh_of_used_points(const PointCloud& cloud, std::vector<Triangle> triangles) {
  std::vector<bool> in_triangle(cloud.positions.size());
  for (const Triangle& t : triangles) {
    for (const std::uint32_t v : t) in_triangle[v] = true;
  }
  UsedPoints used;
  used.number.resize(cloud.positions.size());
  for (std::uint32_t v = 0; v < in_triangle.size(); ++v) {
    if (in_triangle[v]) used.add(v);
  }
  for (Triangle& t : triangles) t = {used.number[t[0]], used.number[t[1]], used.number[t[2]]};
  return mesh_of(cloud, used, std::move(triangles));
}

}  // namespace burnish
