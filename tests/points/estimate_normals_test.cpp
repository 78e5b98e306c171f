#include "burnish/points/estimate_normals.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "burnish/points/unproject.h"
#include "support/depth_scenes.h"

namespace burnish {
namespace {

using namespace test;

double angle(const Vec3f& a, const Vec3d& b) {
  return std::acos(std::clamp(dot(normalized(Vec3d(a)), normalized(b)), -1.0, 1.0));
}

/// Points spread evenly over a unit sphere (Fibonacci's spiral).
std::vector<Vec3d> sphere_points(std::size_t count) {
  std::vector<Vec3d> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1 - (2.0 * static_cast<double>(i) + 1) / static_cast<double>(count);
    const double turn = std::numbers::pi * (3 - std::sqrt(5.0)) * static_cast<double>(i);
    const double r = std::sqrt(1 - z * z);
    points.push_back({r * std::cos(turn), r * std::sin(turn), z});
  }
  return points;
}

PointCloud cloud_of(const std::vector<Vec3d>& points) {
  PointCloud cloud;
  for (const Vec3d& p : points) cloud.positions.push_back(Vec3f(p));
  return cloud;
}

TEST(EstimateNormals, OfASphereWithoutViewpointLookOutwards) {
  const auto points = sphere_points(4000);
  PointCloud cloud = cloud_of(points);
  const auto report = estimate_normals(cloud);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->components, 1u);
  EXPECT_EQ(report->unknown, 0u);
  // 16 points reach sqrt(16 * 4 pi / 4000 / pi) = 0.13; an uneven patch tilts by less than half
  // that.
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LT(angle(cloud.attributes.normals[i], points[i]), 0.06);
  }
}

TEST(EstimateNormals, OfCurvedLinesThatAreFarApartLookAwayFromTheirCentres) {
  // Circles around a cylinder: the sixteen nearest points are an arc of one circle, whose own plane
  // is perpendicular to the surface. All points on top look sideways.
  for (const auto& [radius, around] : {std::pair{1.0, 600}, {0.1, 50}}) {
    PointCloud cloud;
    for (int row = 0; row < 20; ++row) {
      for (int i = 0; i < around; ++i) {
        const double turn = 2 * std::numbers::pi * (i + .3 * (row % 3)) / around;
        cloud.positions.push_back(
            Vec3f(Vec3d{radius * std::cos(turn), radius * std::sin(turn), .1 * row}));
      }
    }
    ASSERT_TRUE(estimate_normals(cloud));
    for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
      const Vec3f& p = cloud.positions[i];
      // The points beside one are off by up to 0.6 of the distance on the circle.
      EXPECT_LT(angle(cloud.attributes.normals[i], {p.x, p.y, 0}),
                .6 * 2 * std::numbers::pi / around + 1e-3);
    }
  }
}

TEST(EstimateNormals, OfATorusWithoutViewpointLookOutwardsAlsoInTheHole) {
  PointCloud cloud;
  std::vector<Vec3d> outwards;
  for (int i = 0; i < 120; ++i) {
    for (int j = 0; j < 40; ++j) {
      const double a = 2 * std::numbers::pi * i / 120, b = 2 * std::numbers::pi * j / 40;
      const Vec3d spoke{std::cos(a), std::sin(a), 0};
      outwards.push_back(std::cos(b) * spoke + Vec3d{0, 0, std::sin(b)});
      cloud.positions.push_back(Vec3f(spoke + 0.35 * outwards.back()));
    }
  }
  ASSERT_TRUE(estimate_normals(cloud));
  for (std::size_t i = 0; i < outwards.size(); ++i) {
    EXPECT_LT(angle(cloud.attributes.normals[i], outwards[i]), 0.2);
  }
}

TEST(EstimateNormals, LookToTheViewpointWhereThereIsOne) {
  PointCloud cloud = cloud_of(sphere_points(1000));
  cloud.viewpoint = Vec3d{0, 0, 0};
  const auto report = estimate_normals(cloud);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->components, 0u);
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    EXPECT_LT(dot(cloud.attributes.normals[i], cloud.positions[i]), 0);
  }
}

TEST(EstimateNormals, OfANoisyPlaneInAGridAreWithinTheWindowsDeviation) {
  DepthFrame frame = empty_frame();
  const Vec3d n = normalized(Vec3d{0.4, 0.2, 1});
  fill(frame, plane(n, 2), 1);
  auto cloud = unproject(frame);
  ASSERT_TRUE(cloud);
  double sum = 0;
  const std::vector<Vec3f> by_unproject = cloud->attributes.normals;
  for (const Vec3f& normal : by_unproject) sum += std::pow(angle(normal, -n), 2);
  // Slopes along both axes deviate by at most 3 degrees each; windows at the border are halved.
  const double rms = std::sqrt(sum / static_cast<double>(by_unproject.size()));
  EXPECT_LT(rms, 1.3 * std::sqrt(2.0) * 3 * std::numbers::pi / 180);

  cloud->attributes.normals.clear();
  ASSERT_TRUE(estimate_normals(*cloud));
  double difference = 0;
  for (std::size_t i = 0; i < by_unproject.size(); ++i) {
    difference += angle(cloud->attributes.normals[i], Vec3d(by_unproject[i]));
  }
  // The same points through world coordinates; sigma across instead of along the ray.
  EXPECT_LT(difference / static_cast<double>(by_unproject.size()), 0.03);
}

TEST(EstimateNormals, DoNotMixSurfacesAtADepthJump) {
  DepthFrame frame = empty_frame();
  const auto front = plane(normalized(Vec3d{0.5, 0, 1}), 1), back = plane({0, 0, 1}, 2);
  fill(frame, [&](const Vec3d& d) { return d.x < 0 ? front(d) : back(d); });
  const auto cloud = unproject(frame, {.window = 4});
  ASSERT_TRUE(cloud);
  for (std::size_t i = 0; i < cloud->positions.size(); ++i) {
    const Vec3d expected = i % 160 < 80 ? normalized(Vec3d{-0.5, 0, -1}) : Vec3d{0, 0, -1};
    EXPECT_LT(angle(cloud->attributes.normals[i], expected), 1e-3) << i;
  }
}

TEST(EstimateNormals, LeavesUnknownWhatHasNoPlane) {
  PointCloud line;
  for (int i = 0; i < 20; ++i) line.positions.push_back({static_cast<float>(i), 0, 0});
  PointCloud one = cloud_of({{1, 2, 3}}), same = cloud_of(std::vector<Vec3d>(10, Vec3d{1, 2, 3}));
  PointCloud empty;
  for (PointCloud* cloud : {&line, &one, &same, &empty}) {
    const auto report = estimate_normals(*cloud);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->unknown, cloud->positions.size());
    EXPECT_EQ(cloud->attributes.normals, std::vector<Vec3f>(cloud->positions.size()));
  }
}

TEST(EstimateNormals, RefusesNaNInAnUnorganizedCloudAndLeavesIt) {
  PointCloud cloud = cloud_of(sphere_points(50));
  cloud.positions[7].y = std::numeric_limits<float>::quiet_NaN();
  const auto report = estimate_normals(cloud);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::bad_geometry);
  EXPECT_TRUE(cloud.attributes.normals.empty());
}

}  // namespace
}  // namespace burnish
