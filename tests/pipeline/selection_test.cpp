#include "burnish/pipeline/selection.h"

#include <gtest/gtest.h>

#include "burnish/io/geometry_file.h"
#include "burnish/shapes/shapes.h"
#include "support/test_data.h"

namespace burnish {
namespace {

TEST(Selection, IsABoxOrABall) {
  const auto box = read_selection("box:0,0,0,1,1,50cm");
  ASSERT_TRUE(box);
  EXPECT_TRUE((*box)({0.5, 1, 0.5}));
  EXPECT_FALSE((*box)({0.5, 1, 0.501}));
  const auto ball = read_selection("sphere:1,2,3,5cm");
  ASSERT_TRUE(ball);
  EXPECT_TRUE((*ball)({1, 2, 3.049}));
  EXPECT_FALSE((*ball)({1, 2, 3.051}));
}

// The nearest points of a finely cut ball's surface lie within its sagitta, well below 1 mm here,
// of the sphere.
TEST(Selection, IsWhatLiesNearASurfaceInTheWorld) {
  const test::TemporaryFolder folder;
  TriangleMesh ball = make_sphere(1, 5);
  ball.frame.origin = {1000, 0, 0};
  const auto path = folder / "one, two.ply";
  ASSERT_TRUE(write_mesh(path, ball));
  const auto near = read_selection("near:" + path.string() + ",10mm");
  ASSERT_TRUE(near) << near.error().text();
  for (const double side : {-1.0, 1.0}) {
    EXPECT_TRUE((*near)({1000, side * 1.009, 0}));
    EXPECT_FALSE((*near)({1000, side * 1.011, 0}));
    EXPECT_TRUE((*near)({1000, 0, side * 0.992}));
    EXPECT_FALSE((*near)({1000, 0, side * 0.989}));
  }
  EXPECT_FALSE((*near)({1000, 0, 0})) << "near the surface, not inside of it";
  EXPECT_FALSE((*near)({0, 1, 0})) << "world coordinates";
}

TEST(Selection, RefusesWhatIsNone) {
  for (const char* text : {"", "near", "near:", "near:a.ply", "near:,1", "near:a.ply,", "cube:1",
                           "near:a.ply,-1mm", "near:a.ply,1kg", "box:1,2", "sphere:0,0,0,0"}) {
    const auto selection = read_selection(text);
    ASSERT_FALSE(selection) << text;
    EXPECT_EQ(selection.error().code, ErrorCode::invalid_argument) << text;
  }
  const auto missing = read_selection("near:no-such-file.ply,1mm");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::not_found);
}

}  // namespace
}  // namespace burnish
