#include "burnish/spatial/closest_point.h"

#include <gtest/gtest.h>

#include "burnish/base/random.h"
#include "burnish/shapes/shapes.h"

namespace burnish {
namespace {

Vec3d random_point(Random& random, double half) {
  const double x = random.uniform(-half, half);
  const double y = random.uniform(-half, half);
  const double z = random.uniform(-half, half);
  return {x, y, z};
}

/// Triangles of all sizes and directions, some of them degenerate.
TriangleMesh soup(std::uint64_t seed) {
  Random random(seed);
  TriangleMesh mesh;
  for (std::uint32_t t = 0; t < 300; ++t) {
    const Vec3d middle = random_point(random, 1);
    const double size = t % 3 == 0 ? 0.5 : 0.02;
    for (int i = 0; i < 3; ++i) {
      mesh.positions.push_back(Vec3f(middle + random_point(random, size)));
    }
    Triangle triangle{3 * t, 3 * t + 1, 3 * t + 2};
    if (t % 10 == 1) triangle[2] = triangle[1];
    if (t % 10 == 2) triangle = {3 * t, 3 * t, 3 * t};
    if (t % 10 == 3) mesh.positions[3 * t + 2] = mesh.positions[3 * t];
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

TEST(ClosestPoint, IsTheLeastOverAllTriangles) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const TriangleMesh mesh = soup(seed);
    const ClosestPoint closest(mesh);
    Random random(seed, 1);
    for (int i = 0; i < 300; ++i) {
      const Vec3d query = random_point(random, i % 2 == 0 ? 1 : 10);
      double least = 1e300;
      for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3d p = closest_on_triangle(query, Vec3d(mesh.positions[a]),
                                            Vec3d(mesh.positions[b]), Vec3d(mesh.positions[c]));
        least = std::min(least, norm(query - p));
      }
      const auto found = closest(query);
      EXPECT_EQ(found.distance, least);
      EXPECT_EQ(norm(query - found.point), found.distance);
      EXPECT_LT(found.triangle, mesh.triangles.size());
    }
  }
}

TEST(ClosestPoint, NoPointOfATriangleIsCloser) {
  Random random(5);
  for (int round = 0; round < 300; ++round) {
    const Vec3d a = random_point(random, 1), b = random_point(random, 1);
    const Vec3d c = round % 4 == 0 ? 0.3 * a + 0.7 * b : random_point(random, 1);
    const Vec3d query = random_point(random, 2);
    const Vec3d found = closest_on_triangle(query, a, b, c);
    const double distance = norm(query - found);
    double least = 1e300;
    constexpr int kSteps = 60;
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; i + j <= kSteps; ++j) {
        const double u = static_cast<double>(i) / kSteps, v = static_cast<double>(j) / kSteps;
        least = std::min(least, norm(query - (a + u * (b - a) + v * (c - a))));
      }
    }
    EXPECT_LE(distance, least + 1e-12);
    // No point of the triangle is farther than 2/3 of a step of its longest edge from a sample.
    const double edge = std::max({norm(b - a), norm(c - a), norm(c - b)});
    EXPECT_GE(distance, least - edge / kSteps);
  }
}

TEST(ClosestPoint, OfTriangleRegions) {
  const Vec3d a{0, 0, 0}, b{4, 0, 0}, c{0, 4, 0};
  EXPECT_EQ(closest_on_triangle({1, 1, 3}, a, b, c), (Vec3d{1, 1, 0}));
  EXPECT_EQ(closest_on_triangle({-1, -1, 3}, a, b, c), a);
  EXPECT_EQ(closest_on_triangle({9, -1, 0}, a, b, c), b);
  EXPECT_EQ(closest_on_triangle({2, -5, 1}, a, b, c), (Vec3d{2, 0, 0}));
  EXPECT_EQ(closest_on_triangle({4, 4, 1}, a, b, c), (Vec3d{2, 2, 0}));
  EXPECT_EQ(closest_on_triangle({1, 2, 3}, a, a, a), a);
  EXPECT_EQ(closest_on_triangle({1, 2, 3}, a, b, b), (Vec3d{1, 0, 0}));
  EXPECT_EQ(closest_on_triangle({3, 2, 3}, a, b, {2, 0, 0}), (Vec3d{3, 0, 0}));
}

TEST(ClosestPoint, TiesGoToTheSmallerNumber) {
  const TriangleMesh mesh = make_grid(8, 8, 1);
  const ClosestPoint closest(mesh);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    for (const std::uint32_t v : {a, b, c}) {
      const auto found = closest(Vec3d(mesh.positions[v]) + Vec3d{0, 0, 2});
      EXPECT_EQ(found.distance, 2);
      EXPECT_LE(found.triangle, t);
    }
  }
}

TEST(ClosestPoint, ThereIsNoneOnAnEmptyMesh) {
  const auto found = ClosestPoint(TriangleMesh{})({0, 0, 0});
  EXPECT_EQ(found.triangle, ~0u);
  EXPECT_EQ(found.distance, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace burnish
