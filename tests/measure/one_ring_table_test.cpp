#include "burnish/measure/one_ring_table.h"

#include <gtest/gtest.h>

#include <numbers>

#include "burnish/shapes/shapes.h"

namespace burnish {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

TEST(OneRingTable, GoesAroundAnInteriorVertex) {
  const TriangleMesh mesh = make_grid(2, 2);  // vertex 4 in the middle, diagonals rising
  const auto table = one_ring_table(mesh, 4);
  ASSERT_TRUE(table);
  std::vector<std::uint32_t> order;
  for (const auto& n : table->neighbours) order.push_back(n.vertex);
  EXPECT_EQ(order, (std::vector<std::uint32_t>{0, 1, 5, 8, 7, 3}));
  const double mean = (4 + 2 * std::numbers::sqrt2) / 6;
  EXPECT_NEAR(table->mean_distance, mean, 1e-15);
  EXPECT_NEAR(table->neighbours[0].distance, std::numbers::sqrt2, 1e-15);
  EXPECT_NEAR(table->neighbours[0].deviation, std::numbers::sqrt2 - mean, 1e-15);
  EXPECT_NEAR(table->neighbours[1].deviation, mean - 1, 1e-15);
  ASSERT_EQ(table->corners.size(), 6u);
  double sum = 0;
  for (const auto& corner : table->corners) sum += corner.angle;
  EXPECT_NEAR(sum, 2 * std::numbers::pi, 1e-14);
  EXPECT_NEAR(table->smallest_angle, 45 * kDegree, 1e-15);
  EXPECT_NEAR(table->largest_angle, 90 * kDegree, 1e-15);
}

TEST(OneRingTable, BeginsAtTheBoundary) {
  const auto table = one_ring_table(make_grid(2, 2), 1);  // in the middle of the lower side
  ASSERT_TRUE(table);
  EXPECT_EQ(table->neighbours.front().vertex, 2u);
  EXPECT_EQ(table->neighbours.back().vertex, 0u);
  EXPECT_EQ(table->corners.size(), 3u);
}

TEST(OneRingTable, ThePrintedDistanceIsNoLength) {
  EXPECT_DOUBLE_EQ(printed_distance({0, 0, 0}, {1, 0, 0}), 1);
  EXPECT_DOUBLE_EQ(printed_distance({0, 0, 0}, {16, 81, 256}), std::sqrt(4. + 9 + 16));
  // The first line of the paper's table.
  EXPECT_NEAR(printed_distance({1.38137, 0, 2.45469}, {1.4, 0, 2.4}), 0.608564450021565, 1e-14);
}

TEST(OneRingTable, OddVertices) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {5, 5, 5}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 4}, {0, 0, 1}};  // two fans and a triangle without a corner
  const auto fans = one_ring_table(mesh, 0);
  ASSERT_TRUE(fans);
  EXPECT_EQ(fans->neighbours.size(), 4u);
  EXPECT_EQ(fans->corners.size(), 2u);
  const auto lonely = one_ring_table(mesh, 5);
  ASSERT_TRUE(lonely);
  EXPECT_TRUE(lonely->neighbours.empty());
  EXPECT_EQ(lonely->mean_distance, 0);
  EXPECT_EQ(one_ring_table(mesh, 6).error().code, ErrorCode::invalid_argument);
}

TEST(OneRingTable, IsMeasuredInTheWorld) {
  TriangleMesh mesh = make_grid(2, 2);
  mesh.frame.origin = {100, 200, 300};
  const auto table = one_ring_table(mesh, 4);
  EXPECT_EQ(table->position, (Vec3d{101, 201, 300}));
  EXPECT_EQ(table->neighbours[0].position, (Vec3d{100, 200, 300}));
}

}  // namespace
}  // namespace burnish
