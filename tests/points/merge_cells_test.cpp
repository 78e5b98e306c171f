#include "burnish/points/merge_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <numeric>

#include "burnish/points/unproject.h"
#include "burnish/spatial/neighbour_grid.h"
#include "support/depth_scenes.h"

namespace burnish {
namespace {

using namespace test;

/// Views of a noisy plane z = 1.2 from one place.
std::vector<PointCloud> plane_views(std::size_t count, double noise = 1) {
  std::vector<PointCloud> clouds;
  for (std::size_t i = 0; i < count; ++i) {
    DepthFrame frame = empty_frame();
    fill(frame, plane({0, 0, 1}, 1.2), noise, 100 + i);
    clouds.push_back(*unproject(frame));
  }
  return clouds;
}

/// Views of a noisy ball of radius 0.2 m at the origin, from a ring of cameras.
std::vector<PointCloud> ball_views(std::size_t count) {
  std::vector<PointCloud> clouds;
  for (std::size_t i = 0; i < count; ++i) {
    const double a = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    DepthFrame frame = empty_frame();
    frame.T_world_camera = look_at({std::cos(a), std::sin(a), 0.2}, {0, 0, 0}, {0, 0, 1});
    fill(frame, ball(frame.T_world_camera.inverse()({0, 0, 0}), 0.2), 1, 7 + i);
    clouds.push_back(*unproject(frame));
  }
  return clouds;
}

bool inner(const Vec3f& p) {
  return std::abs(p.x) < 0.5f && std::abs(p.y) < 0.35f;
}

struct PlaneFigures {
  double sigma = 0, residual = 0;
};

/// Mean sigma and RMS distance to z = 1.2, away from the border.
PlaneFigures plane_figures(const PointCloud& cloud) {
  PlaneFigures figures;
  double count = 0;
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    if (!inner(cloud.positions[i])) continue;
    figures.sigma += cloud.attributes.sigma[i];
    figures.residual += std::pow(cloud.positions[i].z - 1.2, 2);
    ++count;
  }
  return {figures.sigma / count, std::sqrt(figures.residual / count)};
}

TEST(MergeCells, SigmaFallsAsTheRootOfTheViewsAndTheResidualWithIt) {
  const MergeCellsParams white{.spacing = 0.02, .registration = 1e-5, .correlation = 0};
  const auto four = merge_cells(plane_views(4), white);
  const auto sixteen = merge_cells(plane_views(16), white);
  ASSERT_TRUE(four && sixteen);
  const PlaneFigures a = plane_figures(four->cloud), b = plane_figures(sixteen->cloud);
  EXPECT_NEAR(a.sigma / b.sigma, 2, 0.1);
  EXPECT_NEAR(a.residual / b.residual, 2, 0.4);
  // The window of 1.5 spacings weighs as much as 0.556 of its disc, about 3.9 spacings squared
  // against about one of a patch: the residual is about half of sigma and never more.
  for (const PlaneFigures& figures : {a, b}) {
    EXPECT_LT(figures.residual, figures.sigma);
    EXPECT_GT(figures.residual, 0.3 * figures.sigma);
  }
}

TEST(MergeCells, CorrelatedPixelsOfOneImageCountForLess) {
  const auto clouds = plane_views(4);
  const auto white = merge_cells(clouds, {.spacing = 0.02, .correlation = 0});
  const auto same = merge_cells(clouds, {.spacing = 0.02, .correlation = 1});
  ASSERT_TRUE(white && same);
  // Fully correlated, a patch has one measurement a view: n = (0.02 / (1.2 / 146))^2 = 5.9 pixels.
  const double ratio = plane_figures(same->cloud).sigma / plane_figures(white->cloud).sigma;
  EXPECT_NEAR(ratio, std::sqrt(5.9), 0.3);
}

TEST(MergeCells, MakesOneLayerOfEvenlySpacedPoints) {
  const auto merged = merge_cells(ball_views(12));
  ASSERT_TRUE(merged);
  const PointCloud& cloud = merged->cloud;
  ASSERT_TRUE(check(cloud));
  ASSERT_GT(cloud.positions.size(), 500u);
  const double spacing = merged->report.spacing;
  EXPECT_NEAR(spacing, 2 * 0.85 / 146, 0.15 * spacing);
  const NeighbourGrid grid(cloud.positions);
  std::vector<Neighbour> found;
  double worst = 0, squares = 0;
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    grid.nearest(cloud.positions[i], 2, found);
    EXPECT_GE(std::sqrt(found[1].squared_distance), 0.5 * spacing);
    const Vec3d p(cloud.positions[i]);
    const double off = std::abs(norm(p) - 0.2);
    worst = std::max(worst, off);
    squares += off * off;
    EXPECT_GT(dot(normalized(p), Vec3d(cloud.attributes.normals[i])), 0.7);
  }
  // A second layer would lie some sigma (1.6 mm at 0.9 m) from the first; so does an outlier.
  EXPECT_LT(worst, 6e-3);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(cloud.positions.size())), 0.9e-3);
}

TEST(MergeCells, KeepsTheTwoSidesOfAThinSheetApart) {
  std::vector<PointCloud> clouds;
  for (std::size_t i = 0; i < 8; ++i) {
    const bool above = i % 2 == 0;
    DepthFrame frame = empty_frame();
    const double side = above ? 1 : -1;
    frame.T_world_camera = look_at({0, 0, side}, {0, 0, 0}, {0, 1, 0});
    fill(frame, plane({0, 0, 1}, 1 - 0.0015), 1, i);  // 3 mm thick, sigma 1.9 mm
    clouds.push_back(*unproject(frame));
  }
  const auto merged = merge_cells(clouds);
  ASSERT_TRUE(merged);
  double height[2] = {0, 0}, count[2] = {0, 0};
  for (std::size_t i = 0; i < merged->cloud.positions.size(); ++i) {
    const Vec3f n = merged->cloud.attributes.normals[i];
    EXPECT_GT(std::abs(n.z), 0.9);
    height[n.z < 0] += merged->cloud.positions[i].z;
    count[n.z < 0] += 1;
  }
  EXPECT_NEAR(count[0] / count[1], 1, 0.1);
  EXPECT_NEAR(height[0] / count[0], 0.0015, 2e-4);
  EXPECT_NEAR(height[1] / count[1], -0.0015, 2e-4);
}

TEST(MergeCells, CountsEveryObservationOfAPlaneOnce) {
  const auto clouds = plane_views(3, 0);
  const auto merged = merge_cells(clouds);
  ASSERT_TRUE(merged);
  std::size_t sum = 0;
  for (const std::uint32_t n : merged->cloud.attributes.observations) sum += n;
  EXPECT_EQ(merged->report.points_in, 3u * 160 * 120);
  EXPECT_LE(sum, merged->report.points_in);
  EXPECT_GT(sum, merged->report.points_in * 98 / 100);  // corners may lie beyond every kept point
}

TEST(MergeCells, DependsNeitherOnThreadsNorOnTheOrderOfClouds) {
  std::vector<PointCloud> clouds = ball_views(6);
  const auto first = merge_cells(clouds);
  ASSERT_TRUE(first);
  for (const int threads : {1, 2, 3, 8}) {
    std::rotate(clouds.begin(), clouds.begin() + 1, clouds.end());
    std::swap(clouds[1], clouds[4]);
    Context context;
    context.threads = threads;
    const auto again = merge_cells(clouds, {}, context);
    ASSERT_TRUE(again);
    EXPECT_EQ(again->cloud, first->cloud);
  }
}

TEST(MergeCells, DoesNotDependOnTheOrderOfAnUnorganizedCloudsPoints) {
  PointCloud cloud = plane_views(1)[0];
  cloud.grid.reset();
  cloud.viewpoint.reset();
  std::vector<std::uint32_t> order(cloud.positions.size());
  std::iota(order.begin(), order.end(), 0u);
  const PointCloud other = select(cloud, {order.rbegin(), order.rend()});
  for (const MergeCellsParams& params : {MergeCellsParams{}, MergeCellsParams{.spacing = 0.02}}) {
    const auto straight = merge_cells(std::vector<PointCloud>{cloud, cloud}, params);
    const auto reversed = merge_cells(std::vector<PointCloud>{other, other}, params);
    ASSERT_TRUE(straight && reversed);
    EXPECT_EQ(straight->report.spacing, reversed->report.spacing);
    EXPECT_EQ(straight->cloud, reversed->cloud);
  }
}

TEST(MergeCells, StrayNormalsLeaveNoDents) {
  std::vector<PointCloud> clouds = plane_views(6);
  for (PointCloud& cloud : clouds) {
    for (std::size_t i = 0; i < cloud.positions.size(); i += 97) {
      cloud.attributes.normals[i] = normalized(Vec3f{1, 0, -0.8f});
    }
  }
  const auto merged = merge_cells(clouds);
  ASSERT_TRUE(merged);
  for (const Vec3f& p : merged->cloud.positions) {
    // Sigma is 2.4 mm; a window averages more than six of them: five standard deviations.
    if (!inner(p)) continue;
    EXPECT_NEAR(p.z, 1.2, 2.5e-3) << p.x << " " << p.y;
  }
}

TEST(MergeCells, WhatOneFrameSawStaysWhereNoOtherSawItAndGoesWhereManyDid) {
  std::vector<PointCloud> clouds = plane_views(20);
  const auto right = [](const Vec3f& p) { return p.x > 0; };
  constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 1; i < clouds.size(); ++i) {
    for (Vec3f& p : clouds[i].positions) {
      if (right(p)) p = {kMissing, kMissing, kMissing};
    }
  }
  const std::size_t column = 40, row = 60;  // on the left; two pixels fly 5 cm before the plane
  for (const std::size_t i : {row * 160 + column, row * 160 + column + 1}) {
    clouds[0].positions[i] *= 1.15f / 1.2f;
  }
  const auto merged = merge_cells(clouds, {.spacing = 0.02});
  ASSERT_TRUE(merged);
  double shares[2] = {0, 0};  // of the points, left and right
  for (const Vec3f& p : merged->cloud.positions) {
    EXPECT_NEAR(p.z, 1.2, 0.02);
    if (inner(p)) ++shares[right(p)];
  }
  EXPECT_NEAR(shares[0] / shares[1], 1, 0.1);
  // No gap along the border: rows of points across it are never further apart than two spacings.
  const NeighbourGrid grid(merged->cloud.positions);
  std::vector<Neighbour> found;
  for (float y = -0.3f; y < 0.3f; y += 0.01f) {
    for (float x = -0.1f; x < 0.1f; x += 0.01f) {
      grid.nearest({x, y, 1.2f}, 1, found);
      EXPECT_LT(std::sqrt(found[0].squared_distance), 0.03) << x << " " << y;
    }
  }
}

TEST(MergeCells, PixelsAlongOutlinesTellLess) {
  std::vector<PointCloud> clouds = plane_views(2);
  constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
  for (PointCloud& cloud : clouds) {
    for (Vec3f& p : cloud.positions) {
      if (p.x > 0) p = {kMissing, kMissing, kMissing};
    }
  }
  const float pixel = 1.2f / 146;
  const auto merged = merge_cells(clouds, {.spacing = 2 * pixel, .correlation = 0});
  ASSERT_TRUE(merged);
  double sigma[2] = {0, 0}, count[2] = {0, 0};  // within the surface and along its outline
  for (std::size_t i = 0; i < merged->cloud.positions.size(); ++i) {
    const Vec3f& p = merged->cloud.positions[i];
    if (!inner(p)) continue;
    const bool outline = p.x > -pixel;
    sigma[outline] += merged->cloud.attributes.sigma[i];
    count[outline] += 1;
  }
  // Two of three pixels' columns in a patch at the outline count for a sixteenth, or all do.
  EXPECT_GT(sigma[1] / count[1], 1.5 * sigma[0] / count[0]);
  EXPECT_LT(sigma[1] / count[1], 4.5 * sigma[0] / count[0]);
}

/// The mean deviation along x, y and z of merged points near `place`.
Vec3d deviations_near(const PointCloud& cloud, const Vec3d& place) {
  Vec3d sum;
  double count = 0;
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    if (norm(Vec3d(cloud.positions[i]) - place) > 0.1) continue;
    const PointNoise& noise = cloud.attributes.noise[i];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double a = noise.axis[axis];
      sum[axis] += std::sqrt(noise.across * noise.across +
                             a * a * (noise.along * noise.along - noise.across * noise.across));
    }
    ++count;
  }
  EXPECT_GT(count, 3);
  return sum / count;
}

TEST(MergeCells, ViewsFromTwoSidesLeaveASmallerRegionThanEither) {
  std::vector<PointCloud> clouds;
  for (const Vec3d& eye : {Vec3d{3, 0, 0}, Vec3d{0, 3, 0}}) {
    DepthFrame frame = empty_frame();
    frame.T_world_camera = look_at(eye, {0, 0, 0}, {0, 0, 1});
    frame.noise.pixels = 0.2, frame.noise.pixels_grazing = 0;
    fill(frame, ball(frame.T_world_camera.inverse()({0, 0, 0}), 0.5), 1, clouds.size());
    clouds.push_back(*unproject(frame));
  }
  const MergeCellsParams params{.spacing = 0.05, .registration = 1e-5, .correlation = 0};
  const auto both = merge_cells(clouds, params);
  const auto first = merge_cells(std::span(clouds).first(1), params);
  const auto second = merge_cells(std::span(clouds).last(1), params);
  ASSERT_TRUE(both && first && second);
  const Vec3d place = normalized(Vec3d{1, 1, 0}) * 0.5;
  const Vec3d b = deviations_near(both->cloud, place), x = deviations_near(first->cloud, place),
              y = deviations_near(second->cloud, place);
  // At 3 m this camera errs three times as far along its rays as across: what one sees dimly the
  // other sees sharply.
  EXPECT_GT(x.x, 1.5 * x.y);
  EXPECT_GT(y.y, 1.5 * y.x);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_LT(b[axis], x[axis]);
    EXPECT_LT(b[axis], y[axis]);
  }
}

TEST(MergeCells, TakesEmptyCloudsAndSinglePoints) {
  const std::vector<PointCloud> empty(2);
  const auto nothing = merge_cells(empty);
  ASSERT_TRUE(nothing);
  EXPECT_TRUE(nothing->cloud.positions.empty());

  PointCloud one;
  one.positions = {{1, 2, 3}};
  one.attributes.normals = {{0, 0, 1}};
  const auto kept = merge_cells(std::vector<PointCloud>{one}, {.spacing = 0.1});
  ASSERT_TRUE(kept);
  ASSERT_EQ(kept->cloud.positions.size(), 1u);
  EXPECT_LT(norm(kept->cloud.positions[0] - one.positions[0]), 1e-6f);
  const auto left_out =
      merge_cells(std::vector<PointCloud>{one}, {.spacing = 0.1, .min_observations = 2});
  ASSERT_TRUE(left_out);
  EXPECT_TRUE(left_out->cloud.positions.empty());

  PointCloud same;
  same.positions.assign(50, {1, 2, 3});
  same.attributes.normals.assign(50, {0, 0, 1});
  const auto merged = merge_cells(std::vector<PointCloud>{same}, {.spacing = 0.1});
  ASSERT_TRUE(merged);
  ASSERT_EQ(merged->cloud.positions.size(), 1u);
  EXPECT_EQ(merged->cloud.attributes.observations[0], 50u);
  EXPECT_TRUE(merged->cloud.attributes.sigma.empty());
}

TEST(MergeCells, RefusesWhatItCannotWorkOn) {
  const auto refused = [](const std::vector<PointCloud>& clouds, const MergeCellsParams& params) {
    const auto result = merge_cells(clouds, params);
    return result ? std::optional<ErrorCode>() : result.error().code;
  };
  PointCloud cloud;
  cloud.positions = {{1000, 0, 0}};
  EXPECT_EQ(refused({cloud}, {}), ErrorCode::bad_geometry);  // no normals
  cloud.attributes.normals = {{0, 0, 1}};
  EXPECT_EQ(refused({cloud}, {.spacing = 1e-6}), ErrorCode::invalid_argument);
  EXPECT_EQ(refused({}, {}), ErrorCode::invalid_argument);
  EXPECT_EQ(refused({cloud}, {.spacing = -1}), ErrorCode::invalid_argument);
  cloud.positions[0].x = std::nanf("");
  EXPECT_EQ(refused({cloud}, {}), ErrorCode::bad_geometry);
}

}  // namespace
}  // namespace burnish
