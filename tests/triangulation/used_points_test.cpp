#include "burnish/triangulation/used_points.h"

#include <gtest/gtest.h>

#include <limits>

namespace burnish {
namespace {

TEST(MeshOfUsedPoints, CountsMissingPixelsAndPointsThatNoTriangleUses) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  PointCloud cloud;
  cloud.grid = GridSize{3, 2};
  cloud.positions = {{0, 0, 1}, {kNan, kNan, kNan}, {1, 0, 1}, {0, 1, 1}, {5, 5, 5}, {6, 6, 6}};
  const Triangulation result = mesh_of_used_points(cloud, {{0, 2, 3}});
  EXPECT_EQ(result.report.points, 5u);
  EXPECT_EQ(result.report.missing_points, 1u);
  EXPECT_EQ(result.report.unused_points, 2u);
  EXPECT_EQ(result.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

}  // namespace
}  // namespace burnish
