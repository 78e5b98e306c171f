#include "burnish/pipeline/region.h"

#include <gtest/gtest.h>

#include "burnish/base/random.h"

namespace burnish {
namespace {

TEST(Region, ReadsABoxWithUnits) {
  const auto region = parse_region("box:-10cm,0,0,0.5,200mm,1m");
  ASSERT_TRUE(region);
  const Box& box = std::get<Box>(*region);
  EXPECT_EQ(box.low, (Vec3d{-0.1, 0, 0}));
  EXPECT_EQ(box.high, (Vec3d{0.5, 0.2, 1}));
  EXPECT_TRUE(contains(*region, {-0.1, 0, 0})) << "corners belong to the box";
  EXPECT_FALSE(contains(*region, {-0.1001, 0, 0}));
}

TEST(Region, ReadsABall) {
  const auto region = parse_region("sphere:1,2,3,5cm");
  ASSERT_TRUE(region);
  EXPECT_TRUE(contains(*region, {1, 2, 3.049}));
  EXPECT_FALSE(contains(*region, {1, 2, 3.051}));
}

TEST(Region, IsReadBackFromItsText) {
  for (const char* text : {"box:-0.1,0,0,0.5,0.2,1", "sphere:0.1,-2,3e-09,0.05"}) {
    const auto region = parse_region(text);
    ASSERT_TRUE(region);
    EXPECT_EQ(to_string(*region), text);
  }
}

TEST(Region, RefusesWhatIsNeitherAndWhatIsEmpty) {
  for (const char* text : {"", "box", "box:", "box:1,2,3", "cube:0,0,0,1,1,1", "sphere:0,0,0",
                           "box:0,0,0,1,1,1,1", "box:0,0,0,1,1,nan", "box:0,0,0,1,1,0",
                           "sphere:0,0,0,0", "sphere:0,0,0,-1", "sphere:0,0,0,1kg"}) {
    const auto region = parse_region(text);
    ASSERT_FALSE(region) << text;
    EXPECT_EQ(region.error().code, ErrorCode::invalid_argument) << text;
    EXPECT_NE(region.error().message.find('\''), std::string::npos)
        << "the message quotes what came: " << text;
  }
}

/// Whether a point of a fine grid over the triangle lies in the region.
bool sampled(const Region& region, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  constexpr int kSteps = 60;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; i + j <= kSteps; ++j) {
      const double u = double(i) / kSteps, v = double(j) / kSteps;
      if (contains(region, a + (b - a) * u + (c - a) * v)) return true;
    }
  }
  return false;
}

TEST(Region, MeetsTrianglesThatHaveAPointInIt) {
  Random random(1);
  const auto point = [&] {
    Vec3d p;
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = random.uniform(-2, 2);
    return p;
  };
  int met = 0, without_corner = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3d a = point(), b = point(), c = i % 10 == 0 ? a + (b - a) * 0.3 : point();
    // Samples are at most 7 / 60 apart: what a smaller region holds, a larger one must meet.
    const Region smaller[] = {Box{{-0.5, -0.4, -0.3}, {0.5, 0.4, 0.3}}, Ball{{0, 0, 0}, 0.5}};
    const Region larger[] = {Box{{-0.7, -0.6, -0.5}, {0.7, 0.6, 0.5}}, Ball{{0, 0, 0}, 0.7}};
    for (int k = 0; k < 2; ++k) {
      const bool found = meets(smaller[k], a, b, c);
      EXPECT_TRUE(found || !sampled(smaller[k], a, b, c)) << i;
      EXPECT_TRUE(!found || sampled(larger[k], a, b, c)) << i;
      met += found;
      without_corner +=
          found && !contains(smaller[k], a) && !contains(smaller[k], b) && !contains(smaller[k], c);
    }
  }
  EXPECT_GT(met, 50);
  EXPECT_GT(without_corner, 30);
}

}  // namespace
}  // namespace burnish
