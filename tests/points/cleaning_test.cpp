#include <gtest/gtest.h>

#include <stop_token>

#include "burnish/points/remove_flying_pixels.h"
#include "burnish/points/remove_outliers.h"
#include "burnish/points/unproject.h"
#include "support/depth_scenes.h"

namespace burnish {
namespace {

using namespace test;

constexpr std::size_t kEdge = 80;  // first column behind the front plane

/// A front and a back plane, noisy, and two columns between them that belong to neither.
PointCloud planes_with_flying_pixels() {
  DepthFrame frame = empty_frame();
  fill(
      frame, [](const Vec3d& d) { return d.x < 0 ? 1.0 : 1.8; }, 1);
  for (std::size_t row = 0; row < 120; ++row) {
    frame.depth[row * 160 + kEdge] = 1.25f;
    frame.depth[row * 160 + kEdge + 1] = 1.55f;
  }
  return *unproject(frame);
}

TEST(RemoveFlyingPixels, TakesThoseBetweenTwoPlanesAndKeepsThePlanesToTheirEdges) {
  PointCloud cloud = planes_with_flying_pixels();
  const auto report = remove_flying_pixels(cloud);
  ASSERT_TRUE(report);
  ASSERT_TRUE(check(cloud));
  EXPECT_EQ(report->points_before, 160u * 120);
  EXPECT_EQ(report->points_removed, 2u * 120);
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    const bool flying = i % 160 == kEdge || i % 160 == kEdge + 1;
    EXPECT_EQ(is_finite(cloud.positions[i]), !flying) << i;
    EXPECT_EQ(cloud.attributes.observations[i], flying ? 0u : 1u);
  }
}

TEST(RemoveFlyingPixels, TakesPatchesSmallerThanAskedFor) {
  DepthFrame frame = empty_frame();
  fill(frame, plane({0, 0, 1}, 2));
  for (const std::size_t i : {5000u, 5001u, 5002u}) frame.depth[i] = 1;
  for (const int least : {3, 4}) {
    auto cloud = unproject(frame);
    const auto report = remove_flying_pixels(*cloud, {.min_patch = least});
    ASSERT_TRUE(report);
    EXPECT_EQ(report->points_removed, least == 3 ? 0u : 3u);
  }
}

TEST(RemoveFlyingPixels, TakesWhatIsSeenTooSteeply) {
  DepthFrame frame = empty_frame();
  fill(frame, plane(normalized(Vec3d{1.5, 0, 1}), 0.8));
  auto cloud = unproject(frame);
  const PointCloud before = *cloud;
  const double limit = 0.9;
  ASSERT_TRUE(remove_flying_pixels(*cloud, {.max_angle = limit}));
  const Vec3d n = normalized(Vec3d{1.5, 0, 1});
  std::size_t steep = 0;
  for (std::size_t i = 0; i < before.positions.size(); ++i) {
    if (!is_finite(before.positions[i])) continue;
    const double theta = std::acos(dot(n, normalized(Vec3d(before.positions[i]))));
    if (std::abs(theta - limit) < 1e-3) continue;
    EXPECT_EQ(is_finite(cloud->positions[i]), theta < limit);
    steep += theta > limit;
  }
  EXPECT_GT(steep, 100u);
}

TEST(RemoveFlyingPixels, RefusesAnUnorganizedCloud) {
  PointCloud cloud;
  cloud.positions = {{1, 2, 3}};
  const auto report = remove_flying_pixels(cloud);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::bad_geometry);
}

TEST(RemoveFlyingPixels, LeavesTheCloudWhenCancelled) {
  PointCloud cloud = planes_with_flying_pixels();
  const std::vector<float> before = cloud.attributes.sigma;
  std::stop_source source;
  source.request_stop();
  Context context;
  context.stop = source.get_token();
  const auto report = remove_flying_pixels(cloud, {}, context);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::cancelled);
  EXPECT_EQ(cloud.attributes.sigma, before);
}

/// A grid of points `step` apart, jittered by a tenth.
void add_grid(PointCloud& cloud, int side, double step, double x) {
  Random random(5);
  for (int i = 0; i < side * side; ++i) {
    const double u = random.uniform(-0.1, 0.1), v = random.uniform(-0.1, 0.1);
    cloud.positions.push_back(Vec3f(Vec3d{x + (i % side + u) * step, (i / side + v) * step, 0}));
  }
}

TEST(RemoveOutliers, TakesLonePointsAndKeepsSparseRegions) {
  PointCloud cloud;
  add_grid(cloud, 30, 0.01, 0);  // dense
  add_grid(cloud, 20, 0.05, 2);  // five times sparser
  const std::size_t good = cloud.positions.size();
  for (const Vec3f& lone : {Vec3f{.1f, .1f, .1f}, Vec3f{.2f, .1f, -.6f}, Vec3f{4, 3, 0},
                            Vec3f{2.5f, .5f, .4f}, Vec3f{-.5f, 2, 1}}) {
    cloud.positions.push_back(lone);
  }
  for (int i = 0; i < 4; ++i) {  // a clump of half of the neighbours
    cloud.positions.push_back({-1, 0.001f * static_cast<float>(i), 0});
  }
  const auto report = remove_outliers(cloud);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->points_removed, 9u);
  EXPECT_EQ(cloud.positions.size(), good);
}

TEST(RemoveOutliers, LeavesCloudsOfAFewPointsAndOfOnePlace) {
  for (const std::size_t count : {0u, 1u, 8u, 100u}) {
    PointCloud cloud;
    cloud.positions.assign(count, {1, 2, 3});
    const auto report = remove_outliers(cloud);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->points_removed, 0u);
    EXPECT_EQ(cloud.positions.size(), count);
  }
}

TEST(RemoveOutliers, MarksOutliersOfAGridAsMissing) {
  DepthFrame frame = empty_frame(40, 30);
  fill(frame, plane({0, 0, 1}, 2));
  frame.depth[615] = 1;
  auto cloud = unproject(frame);
  const auto report = remove_outliers(*cloud);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->points_removed, 1u);
  EXPECT_EQ(cloud->positions.size(), 1200u);
  EXPECT_FALSE(is_finite(cloud->positions[615]));
}

}  // namespace
}  // namespace burnish
