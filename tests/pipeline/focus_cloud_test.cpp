#include "burnish/pipeline/focus_cloud.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "burnish/shapes/shapes.h"

namespace burnish {
namespace {

TEST(FocusCloud, KeepsEveryPointInsideAndThinsTheRest) {
  PointCloud cloud;
  cloud.positions = make_sphere(1, 3).positions;
  cloud.frame.origin = {100, 0, 0};
  const PointCloud before = cloud;
  const auto inside = [](const Vec3f& p) { return p.z >= 0.5f; };
  const auto count = [&](const PointCloud& c) {
    return std::count_if(c.positions.begin(), c.positions.end(), inside);
  };
  Record record;
  ASSERT_TRUE(focus_cloud(cloud, "box:99,-1,0.5,101,1,1", 50, record));
  EXPECT_EQ(count(cloud), count(before));
  EXPECT_EQ(cloud.positions.size(), static_cast<std::size_t>(count(before)) + 50);
  EXPECT_EQ(record.steps.at(0).verb, "adapt");
  EXPECT_EQ(record.steps.at(0).facts.back().value, static_cast<double>(count(before)));
}

TEST(FocusCloud, LeavesMissingPixelsOut) {
  PointCloud cloud;
  cloud.positions = make_grid(9, 9).positions;
  cloud.positions[35] = Vec3f{1, 1, 1} * std::numeric_limits<float>::quiet_NaN();
  cloud.grid = GridSize{10, 10};
  Record record;
  ASSERT_TRUE(focus_cloud(cloud, "sphere:0,0,0,3", 20, record));
  for (const Vec3f& p : cloud.positions) EXPECT_TRUE(is_finite(p));
}

TEST(FocusCloud, RefusesARegionWithoutAPoint) {
  PointCloud cloud;
  cloud.positions = make_sphere(1, 2).positions;
  const PointCloud before = cloud;
  Record record;
  const auto done = focus_cloud(cloud, "sphere:5,0,0,2", 10, record);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::invalid_argument);
  EXPECT_EQ(cloud, before);
  EXPECT_TRUE(record.steps.empty());
}

}  // namespace
}  // namespace burnish
