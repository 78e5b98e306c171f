#include "burnish/core/transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace burnish {
namespace {

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

/// Half a turn around z, then a shift.
RigidTransform turned_and_shifted(const Vec3d& shift) {
  return {{{{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}}}, shift};
}

TEST(Transform, MovesPositionsNormalsNoiseAndViewpoint) {
  PointCloud cloud;
  cloud.positions = {{1, 2, 3}};
  cloud.attributes.normals = {{1, 0, 0}};
  cloud.attributes.noise = {{{0, 1, 0}, 0.2f, 0.1f}};
  cloud.viewpoint = Vec3d{0, 1, 0};
  const PointCloud moved = transformed(cloud, turned_and_shifted({10, 0, 0}));
  EXPECT_EQ(moved.positions[0], (Vec3f{9, -2, 3}));
  EXPECT_EQ(moved.attributes.normals[0], (Vec3f{-1, 0, 0}));
  EXPECT_EQ(moved.attributes.noise[0], (PointNoise{{0, -1, 0}, 0.2f, 0.1f}));
  EXPECT_EQ(moved.viewpoint, (Vec3d{10, -1, 0}));
  EXPECT_EQ(moved.frame, Frame{});
}

TEST(Transform, AnOrganizedCloudWithoutViewpointWasSeenFromTheOrigin) {
  PointCloud cloud;
  cloud.grid = GridSize{2, 1};
  cloud.positions = {{0, 0, 1}, {kMissing, kMissing, kMissing}};
  const PointCloud moved = transformed(cloud, turned_and_shifted({1, 2, 3}));
  EXPECT_EQ(moved.viewpoint, (Vec3d{1, 2, 3}));
  EXPECT_TRUE(std::isnan(moved.positions[1].x));
}

TEST(Transform, FarFromTheOriginPositionsKeepTheirPrecision) {
  PointCloud cloud;
  cloud.positions = {{0.125f, 0.001f, 1}, {0.1253f, 0.001f, 1}};
  const Vec3d shift{500000.25, 4649776.5, 100};
  const PointCloud moved = transformed(cloud, {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, shift});
  EXPECT_EQ(moved.frame.origin, (Vec3d{500000, 4649777, 100}));
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec3d world = moved.frame.origin + Vec3d(moved.positions[i]);
    // Positions of the size of a metre are rounded by at most 2^-24 of it.
    EXPECT_LT(norm(world - (Vec3d(cloud.positions[i]) + shift)), 2e-7);
  }
}

}  // namespace
}  // namespace burnish
