#include "burnish/sensor/nearest_time.h"

#include <gtest/gtest.h>

namespace burnish {
namespace {

TEST(NearestTime, IsFoundOnBothSidesWithinTheWindow) {
  const NearestTime times({3.0, 1.0, 2.0});
  EXPECT_EQ(times.find(1.9, 0.2), 2u);
  EXPECT_EQ(times.find(2.1, 0.2), 2u);
  EXPECT_EQ(times.find(0.0, 1.0), 1u);
  EXPECT_EQ(times.find(9.0, 6.0), 0u);
  EXPECT_EQ(times.find(1.5, 0.5), 1u);  // equally near: the earlier
  EXPECT_FALSE(times.find(2.3, 0.2));
  EXPECT_FALSE(NearestTime({}).find(0, 1e9));
}

}  // namespace
}  // namespace burnish
