#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "burnish/measure/area_and_volume.h"
#include "burnish/measure/noise_estimate.h"
#include "burnish/measure/triangle_quality.h"
#include "burnish/shapes/shapes.h"
#include "support/random_mesh.h"

namespace burnish {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Histogram, CountsEveryValueOnce) {
  const std::vector<double> values{-1, 0, 0.1, 0.5, 0.99, 1, 7};
  const Histogram h = histogram(values, 0, 1, 4);
  EXPECT_EQ(h.counts, (std::vector<std::uint64_t>{3, 0, 1, 3}));
  EXPECT_EQ(h.bin_width(), 0.25);
}

TEST(Histogram, QuantileIsAnElement) {
  std::vector<double> values{5, 1, 4, 2, 3};
  EXPECT_EQ(quantile(values, 0), 1);
  EXPECT_EQ(quantile(values, 0.5), 3);
  EXPECT_EQ(quantile(values, 0.95), 5);
  EXPECT_EQ(quantile(values, 1), 5);
  values.clear();
  EXPECT_EQ(quantile(values, 0.5), 0);
}

TEST(TriangleQuality, OfRightTriangles) {
  const auto quality = triangle_quality(make_grid(3, 2, 2));
  ASSERT_TRUE(quality);
  EXPECT_EQ(quality->triangles, 12u);
  EXPECT_NEAR(quality->smallest_angle, kPi / 4, 1e-15);
  EXPECT_NEAR(quality->smallest_angle_p01, kPi / 4, 1e-15);
  EXPECT_NEAR(quality->smallest_angle_mean, kPi / 4, 1e-15);
  EXPECT_NEAR(quality->largest_angle, kPi / 2, 1e-15);
  // 2 r / R with r = (a + b - c) / 2 and R = c / 2 for the sides 1, 1, sqrt 2.
  const double ratio = 2 * (2 - std::numbers::sqrt2) / std::numbers::sqrt2;
  EXPECT_NEAR(quality->radius_ratio_min, ratio, 1e-15);
  EXPECT_NEAR(quality->radius_ratio_mean, ratio, 1e-15);
  // 3 * 3 + 4 * 2 = 17 sides of length 2 and 6 diagonals.
  EXPECT_NEAR(quality->edge_length_mean, (17 * 2 + 6 * 2 * std::numbers::sqrt2) / 23, 1e-14);
  EXPECT_EQ(quality->edge_length_min, 2);
  EXPECT_NEAR(quality->edge_length_max, 2 * std::numbers::sqrt2, 1e-15);
  const auto& counts = quality->angles.counts;
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}), 36u);
  const auto& lengths = quality->edge_lengths.counts;
  EXPECT_EQ(std::accumulate(lengths.begin(), lengths.end(), std::uint64_t{0}), 23u);
}

TEST(TriangleQuality, OfEquilateralTriangles) {
  const auto quality = triangle_quality(make_sphere(1, 0));
  ASSERT_TRUE(quality);
  EXPECT_NEAR(quality->smallest_angle, kPi / 3, 1e-6);
  EXPECT_NEAR(quality->radius_ratio_mean, 1, 1e-6);
  EXPECT_NEAR(quality->edge_spread, 0, 1e-6);
  EXPECT_NEAR(quality->neighbour_distance_spread, 0, 1e-6);
}

TEST(TriangleQuality, NeighbourDistanceSpreadOfOneVertex) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 3, 0}};
  mesh.triangles = {{0, 1, 2}};
  const double a = 1, b = 3, c = std::sqrt(10.);
  const auto cv = [](double x, double y) { return std::abs(x - y) / (x + y); };
  const auto quality = triangle_quality(mesh);
  EXPECT_NEAR(quality->neighbour_distance_spread, (cv(a, b) + cv(a, c) + cv(b, c)) / 3, 1e-15);
}

TEST(TriangleQuality, DegenerateAndEmptyMeshesHaveFiniteMeasures) {
  TriangleMesh mesh = make_grid(1, 1);
  mesh.triangles.push_back({0, 0, 1});
  mesh.triangles.push_back({2, 2, 2});
  for (const TriangleMesh& odd : {mesh, TriangleMesh{}}) {
    const auto quality = triangle_quality(odd);
    ASSERT_TRUE(quality);
    EXPECT_EQ(quality->radius_ratio_min, 0);
    EXPECT_EQ(quality->smallest_angle, 0);
    for (const Fact& fact : quality->facts()) EXPECT_TRUE(std::isfinite(fact.value)) << fact.key;
  }
}

TEST(AreaAndVolume, OfABox) {
  const auto box = area_and_volume(make_box({1, 2, 3}, 3));
  ASSERT_TRUE(box);
  EXPECT_NEAR(box->area, 22, 1e-5);
  ASSERT_TRUE(box->volume);
  EXPECT_NEAR(*box->volume, 6, 1e-5);
}

TEST(AreaAndVolume, OnlyClosedOrientedMeshesHaveAVolume) {
  EXPECT_FALSE(area_and_volume(make_grid(3, 3))->volume);
  EXPECT_EQ(area_and_volume(make_grid(3, 3))->area, 9);
  TriangleMesh flipped = make_box();
  std::swap(flipped.triangles[0][0], flipped.triangles[0][1]);
  EXPECT_FALSE(area_and_volume(flipped)->volume);
  EXPECT_FALSE(area_and_volume(TriangleMesh{})->volume);
  TriangleMesh inside_out = make_box();
  for (Triangle& t : inside_out.triangles) std::swap(t[0], t[1]);
  EXPECT_NEAR(area_and_volume(inside_out)->volume.value_or(0), -1, 1e-6);
}

TEST(AreaAndVolume, DoesNotDependOnWhereTheMeshIs) {
  TriangleMesh far = make_box({1, 1, 1}, 4);
  for (Vec3f& p : far.positions) p += {1024, -2048, 512};  // exact: quarters
  EXPECT_NEAR(area_and_volume(far)->volume.value_or(0), 1, 1e-12);
}

TEST(NoiseEstimate, FindsWhiteNoiseOnASmoothSurface) {
  const TriangleMesh clean = make_sphere(1, 5);
  for (const double sigma : {0.002, 0.005, 0.01}) {
    const auto estimate = estimate_noise(test::with_noise(clean, sigma, 7));
    ASSERT_TRUE(estimate);
    EXPECT_EQ(estimate->vertices, clean.positions.size());
    EXPECT_NEAR(estimate->sigma / sigma, 1, 0.15);
  }
  EXPECT_LT(estimate_noise(clean)->sigma, 0.001);
}

}  // namespace
}  // namespace burnish
