#include "burnish/points/precision.h"

#include <gtest/gtest.h>

#include <cmath>

#include "burnish/base/random.h"

namespace burnish {
namespace {

Vec3d any_direction(Random& random) {
  Vec3d d;
  for (std::size_t axis = 0; axis < 3; ++axis) d[axis] = random.normal();
  return normalized(d);
}

/// How many standard deviations `d` is.
double ratio(const PointNoise& noise, const Vec3d& d) {
  const double along = dot(d, Vec3d(noise.axis));
  return std::hypot(along / noise.along, norm(cross(d, Vec3d(noise.axis))) / noise.across);
}

Precision sum(const Precision& a, const Precision& b) {
  Precision result{};
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = a[i] + b[i];
  return result;
}

TEST(Precision, OfOneMeasurementMeansItsNoise) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d axis = any_direction(random);
    const double across = random.uniform(0.001, 0.002), along = across * random.uniform(0.2, 5);
    if (std::abs(along / across - 1) < 0.01) continue;  // the axis has no meaning
    const PointNoise noise{Vec3f(axis), static_cast<float>(along), static_cast<float>(across)};
    const PointNoise back = noise_within(precision_of(noise, 1e-9), Vec3f(-axis));
    // The axis is a float: off by 1e-7 of the shorter deviation's share, (5^2) times at most.
    EXPECT_GT(dot(Vec3d(back.axis), axis), 1 - 1e-6);
    EXPECT_NEAR(back.along, along, 1e-5 * along);
    EXPECT_NEAR(back.across, across, 1e-5 * across);
  }
}

TEST(Precision, TwoViewsLeaveASmallerRegionThanEither) {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const PointNoise a{Vec3f(any_direction(random)), 0.004f, 0.001f};
    const PointNoise b{Vec3f(any_direction(random)), 0.003f, 0.0015f};
    const PointNoise both = noise_within(sum(precision_of(a, 1e-9), precision_of(b, 1e-9)), {});
    for (int k = 0; k < 20; ++k) {
      const Vec3d d = any_direction(random);
      EXPECT_GT(ratio(both, d), std::max(ratio(a, d), ratio(b, d)));
      EXPECT_GT(ratio(both, d), std::hypot(ratio(a, d), ratio(b, d)) * (1 - 1e-5));
    }
  }
}

TEST(Precision, OfViewsFromTheSideIsNearlyRoundAndAsSharpAsTheSharperOne) {
  const PointNoise front{{0, 0, 1}, 0.01f, 0.001f}, side{{1, 0, 0}, 0.01f, 0.001f};
  const PointNoise both =
      noise_within(sum(precision_of(front, 1e-9), precision_of(side, 1e-9)), {});
  EXPECT_NEAR(both.along, 0.001 / std::sqrt(2), 1e-6);  // y, which both see sharply
  EXPECT_NEAR(both.across, 0.001 / std::sqrt(1.01), 1e-6);
  EXPECT_NEAR(std::abs(both.axis.y), 1, 1e-6);
}

TEST(Precision, OfNothingToSpeakOfIsStillARegion) {
  const PointNoise noise = noise_within({1e6, 0, -1e-3, 0, 0, 0}, {});
  EXPECT_TRUE(std::isfinite(noise.along) && std::isfinite(noise.across));
  EXPECT_GT(noise.across, 0);
}

}  // namespace
}  // namespace burnish
