#include "burnish/pipeline/region.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace burnish
