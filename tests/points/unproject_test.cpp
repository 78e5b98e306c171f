#include "burnish/points/unproject.h"

#include <gtest/gtest.h>

#include <numbers>

#include "support/depth_scenes.h"

namespace burnish {
namespace {

using namespace test;

double angle(const Vec3d& a, const Vec3d& b) {
  return std::acos(std::clamp(dot(normalized(a), normalized(b)), -1.0, 1.0));
}

TEST(Unproject, PutsPixelsOfAPlaneOntoItInWorldCoordinates) {
  DepthFrame frame = empty_frame();
  const Vec3d n = normalized(Vec3d{0.3, -0.2, 1});
  fill(frame, plane(n, 1.5));
  frame.T_world_camera = look_at({1, 2, 3}, {0, 0.5, 1}, {0, 0, 1});
  const auto cloud = unproject(frame);
  ASSERT_TRUE(cloud);
  ASSERT_TRUE(check(*cloud));
  EXPECT_EQ(cloud->grid, (GridSize{160, 120}));
  EXPECT_EQ(*cloud->viewpoint, (Vec3d{1, 2, 3}));
  const RigidTransform T_camera_world = frame.T_world_camera.inverse();
  for (std::size_t i = 0; i < cloud->positions.size(); ++i) {
    const Vec3d p = T_camera_world(Vec3d(cloud->positions[i]));
    // Float depth and float coordinates of up to 4 m: half a unit in the last place each.
    EXPECT_NEAR(dot(n, p), 1.5, 1e-6);
    const Vec3d pixel = frame.camera.project(p);
    EXPECT_NEAR(pixel.x, static_cast<double>(i % 160), 1e-4);
    EXPECT_NEAR(pixel.y, static_cast<double>(i / 160), 1e-4);
  }
}

TEST(Unproject, TurnsNormalsToTheCameraExactlyWithoutNoise) {
  DepthFrame frame = empty_frame();
  const Vec3d n = normalized(Vec3d{0.6, 0.3, 1});
  fill(frame, plane(n, 1));
  frame.T_world_camera = look_at({1, 2, 3}, {0, 0.5, 1}, {0, 0, 1});
  const auto cloud = unproject(frame);
  ASSERT_TRUE(cloud);
  const Vec3d expected = frame.T_world_camera.rotate(-n);
  for (std::size_t i = 0; i < cloud->positions.size(); ++i) {
    // Depths are rounded to 6e-8 of 1 m over a window of at least 2 pixels of 7 mm.
    EXPECT_LT(angle(Vec3d(cloud->attributes.normals[i]), expected), 1e-4);
  }
}

TEST(Unproject, GivesSigmaByTheFormula) {
  DepthFrame frame = empty_frame();
  frame.noise.grazing = 0.0001;
  frame.noise.power = -0.5;
  frame.noise.grazing_from = std::numbers::pi / 3;
  const Vec3d n = normalized(Vec3d{2, 0, 1});
  fill(frame, plane(n, 0.6));
  const auto cloud = unproject(frame);
  ASSERT_TRUE(cloud);
  std::size_t seen = 0;
  for (std::size_t i = 0; i < cloud->positions.size(); ++i) {
    if (!is_finite(cloud->positions[i])) continue;
    ++seen;
    const double z = frame.depth[i];
    const double theta = angle(Vec3d(cloud->positions[i]), Vec3d(-cloud->attributes.normals[i]));
    const double expected = std::hypot(frame.noise.axial(z, theta) * std::cos(theta),
                                       frame.noise.lateral(z, theta, 146) * std::sin(theta));
    EXPECT_NEAR(cloud->attributes.sigma[i], expected, 1e-5 * expected);
    const PointNoise& noise = cloud->attributes.noise[i];
    EXPECT_LT(angle(Vec3d(cloud->positions[i]), Vec3d(noise.axis)), 1e-3);
    EXPECT_NEAR(norm(noise.axis), 1, 1e-6);
    EXPECT_NEAR(noise.along, frame.noise.axial(z, theta), 1e-5 * noise.along);
    EXPECT_NEAR(noise.across, frame.noise.lateral(z, theta, 146), 1e-5 * noise.across);
    EXPECT_EQ(cloud->attributes.observations[i], 1u);
    EXPECT_EQ(cloud->attributes.origin[i], Origin::seen);
  }
  EXPECT_GT(seen, 5000u);
}

TEST(Unproject, TakesWhatIsLeftOfTheNoiseFromTheFrame) {
  DepthFrame frame = empty_frame();
  fill(frame, plane({0, 0, 1}, 1));
  const auto single = unproject(frame, {.window = 2});
  frame.noise_share.assign(frame.depth.size(), 0.5f);
  frame.observations.assign(frame.depth.size(), 4);
  const auto mean = unproject(frame, {.window = 2});
  frame.sigma_share.assign(frame.depth.size(), 0.25f);
  const auto smoothed = unproject(frame, {.window = 2});
  ASSERT_TRUE(single && mean && smoothed);
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    const PointNoise &one = single->attributes.noise[i], &four = mean->attributes.noise[i];
    EXPECT_FLOAT_EQ(four.along, 0.5f * one.along);
    EXPECT_EQ(four.across, one.across);
    EXPECT_EQ(smoothed->attributes.noise[i], four);
    EXPECT_EQ(mean->attributes.observations[i], 4u);
    // Of sigma^2 = axial^2 cos^2 + lateral^2 sin^2 a share goes.
    const double cosine =
        std::cos(angle(Vec3d(single->positions[i]), Vec3d(-1.f * single->attributes.normals[i])));
    const auto expected = [&](double share) {
      const double all = single->attributes.sigma[i], axial = one.along * cosine;
      return std::sqrt(all * all - (1 - share * share) * axial * axial);
    };
    EXPECT_NEAR(mean->attributes.sigma[i], expected(0.5), 1e-8);
    EXPECT_NEAR(smoothed->attributes.sigma[i], expected(0.25), 1e-8);
  }
}

TEST(Unproject, LeavesOutWhatIsNoMeasurement) {
  DepthFrame frame = empty_frame();
  fill(frame, plane({0, 0, 1}, 2));
  frame.depth[0] = 0;
  frame.depth[1] = 0.39f;
  frame.depth[2] = 4.51f;
  const auto cloud = unproject(frame);
  ASSERT_TRUE(cloud);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(std::isnan(cloud->positions[i].x) && std::isnan(cloud->positions[i].z));
    EXPECT_EQ(cloud->attributes.sigma[i], 0);
    EXPECT_EQ(cloud->attributes.noise[i], PointNoise{});
    EXPECT_EQ(cloud->attributes.observations[i], 0u);
    EXPECT_EQ(cloud->attributes.normals[i], Vec3f{});
  }
  EXPECT_TRUE(is_finite(cloud->positions[3]));
  const auto near_only = unproject(frame, {.max_depth = 1});
  ASSERT_TRUE(near_only);
  EXPECT_FALSE(is_finite(near_only->positions[3]));
}

TEST(Unproject, WithoutNormalsIsTheSamePointsWithTheAxialDeviation) {
  DepthFrame frame = empty_frame();
  fill(frame, plane(normalized(Vec3d{0.6, 0.3, 1}), 1), 1);
  frame.depth[77] = 0;
  frame.T_world_camera = look_at({1, 2, 3}, {0, 0.5, 1}, {0, 0, 1});
  frame.sigma_share.assign(frame.depth.size(), 0.5f);
  const auto all = unproject(frame), bare = unproject(frame, {.normals = false});
  ASSERT_TRUE(all && bare);
  EXPECT_TRUE(bare->attributes.normals.empty() && bare->attributes.noise.empty());
  EXPECT_EQ(bare->attributes.observations, all->attributes.observations);
  EXPECT_EQ(bare->attributes.origin, all->attributes.origin);
  PointCloud reused;
  reused.positions.assign(5, {});
  ASSERT_TRUE(unproject_into(frame, {}, {}, reused));
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    const bool missing = i == 77;
    EXPECT_EQ(is_finite(bare->positions[i]), !missing);
    if (!missing) {
      EXPECT_EQ(bare->positions[i], all->positions[i]);
      EXPECT_EQ(reused.positions[i], all->positions[i]);
    }
    const double sigma = missing ? 0 : 0.5 * frame.noise.axial(frame.depth[i], 0);
    EXPECT_FLOAT_EQ(bare->attributes.sigma[i], static_cast<float>(sigma));
  }
  EXPECT_EQ(reused.attributes, bare->attributes);
}

TEST(Unproject, RefusesABrokenFrame) {
  DepthFrame frame = empty_frame();
  frame.depth.pop_back();
  const auto cloud = unproject(frame);
  ASSERT_FALSE(cloud);
  EXPECT_EQ(cloud.error().code, ErrorCode::bad_geometry);
  EXPECT_FALSE(unproject(empty_frame(), {.min_depth = -1}));
}

}  // namespace
}  // namespace burnish
