#include "burnish/smoothing/one_ring_mean.h"

#include <gtest/gtest.h>

namespace burnish {
namespace {

/// A hexagon of unit radius around a raised centre.
TriangleMesh hat() {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 1},  {1, 0, 0},       {.5f, .8f, 0}, {-.5f, .8f, 0},
                    {-1, 0, 0}, {-.5f, -.8f, 0}, {.5f, -.8f, 0}};
  for (std::uint32_t i = 0; i < 6; ++i) mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % 6});
  return mesh;
}

TEST(OneRingMean, MovesAnInteriorVertexToTheMeanOfRingAndItself) {
  TriangleMesh mesh = hat();
  const auto report = smooth_one_ring_mean(mesh);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->moved_vertices, 1u);
  EXPECT_EQ(mesh.positions[0], (Vec3f{0, 0, 1.f / 7}));
}

TEST(OneRingMean, RefusesAnIndexOutOfRangeAndLeavesTheMesh) {
  TriangleMesh mesh = hat();
  mesh.triangles.push_back({0, 1, 99});
  const TriangleMesh before = mesh;
  const auto report = smooth_one_ring_mean(mesh);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::bad_geometry);
  EXPECT_EQ(mesh, before);
}

}  // namespace
}  // namespace burnish
