#include "burnish/triangulation/triangle_gap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "burnish/base/random.h"

namespace burnish {
namespace {

/// The same by looking at the points of a lattice over the triangle.
double sampled_gap(const Vec3d& a, const Vec3d& b, const Vec3d& c, int steps) {
  double widest = 0;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= steps - i; ++j) {
      const double u = static_cast<double>(i) / steps, v = static_cast<double>(j) / steps;
      const Vec3d p = a + u * (b - a) + v * (c - a);
      widest = std::max(widest, std::min({norm(p - a), norm(p - b), norm(p - c)}));
    }
  }
  return widest;
}

TEST(TriangleGap, IsTheFarthestFromTheCorners) {
  Random random(5);
  const auto point = [&] {
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1), z = random.uniform(-1, 1);
    return Vec3d{x, y, z};
  };
  constexpr int kSteps = 200;
  for (int i = 0; i < 60; ++i) {
    const Vec3d a = point(), b = point(), c = point();
    const double longest = std::max({norm(b - a), norm(c - b), norm(a - c)});
    const double sampled = sampled_gap(a, b, c, kSteps);
    EXPECT_GE(triangle_gap(a, b, c), sampled - 1e-12);
    EXPECT_LE(triangle_gap(a, b, c), sampled + 2 * longest / kSteps);
  }
}

TEST(TriangleGap, IsThatOfTheRightAngleFromBothSides) {
  const Vec3d a{0, 0, 0}, b{3, 0, 0};
  for (const double x : {-1e-9, 0.0, 1e-9}) {
    EXPECT_NEAR(triangle_gap(a, b, {x, 4, 0}), 2.5, 1e-8);
  }
}

TEST(TriangleGap, IsThatOfTheLinesPartsWhereAllIsOnALine) {
  EXPECT_DOUBLE_EQ(triangle_gap({0, 0, 0}, {1, 0, 0}, {4, 0, 0}), 1.5);
  EXPECT_DOUBLE_EQ(triangle_gap({0, 0, 0}, {2, 0, 0}, {4, 0, 0}), 1);
  EXPECT_DOUBLE_EQ(triangle_gap({0, 0, 0}, {0, 0, 0}, {4, 0, 0}), 2);
}

}  // namespace
}  // namespace burnish
