#include "burnish/adaptation/removal_order.h"

#include <gtest/gtest.h>

#include <limits>

#include "burnish/shapes/shapes.h"
#include "support/plain_removals.h"
#include "support/random_mesh.h"

namespace burnish {
namespace {

TriangleMesh with_triangles(std::vector<Triangle> triangles) {
  TriangleMesh mesh;
  for (const Triangle& t : triangles) {
    for (const std::uint32_t v : t)
      mesh.positions.resize(std::max<std::size_t>(mesh.positions.size(), v + 1));
  }
  mesh.triangles = std::move(triangles);
  return mesh;
}

void expect_refused(const TriangleMesh& mesh, const std::vector<Removal>& log, const char* where,
                    const char* why) {
  const auto order = RemovalOrder::make(mesh, log);
  ASSERT_FALSE(order) << why;
  EXPECT_EQ(order.error().code, ErrorCode::invalid_argument);
  EXPECT_EQ(order.error().where, where);
  EXPECT_NE(order.error().message.find(why), std::string::npos) << order.error().text();
}

TEST(RemovalOrder, RefusesWhatWouldNotLeaveTheSurface) {
  const TriangleMesh grid = make_grid(3, 3);  // vertices 5, 6, 9 and 10 are within
  expect_refused(grid, {{16, 0}}, "removal 0", "of 16");
  expect_refused(grid, {{5, 5}}, "removal 0", "no edge");
  expect_refused(grid, {{5, 15}}, "removal 0", "no edge");
  expect_refused(grid, {{5, 6}, {5, 9}}, "removal 1", "no edge");
  expect_refused(grid, {{1, 5}}, "removal 0", "on the boundary");
  const TriangleMesh tetrahedron = with_triangles({{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}});
  expect_refused(tetrahedron, {{0, 1}}, "removal 0", "two triangles");
  expect_refused(with_triangles({{0, 1, 2}}), {{0, 1}}, "removal 0", "0 others");
  expect_refused(with_triangles({{0, 1, 2}, {2, 1, 3}, {2, 1, 4}}), {{0, 1}}, "removal 0",
                 "2 others");
  expect_refused(with_triangles({{0, 1, 2}, {0, 3, 4}}), {{0, 1}}, "removal 0", "one fan");
  expect_refused(with_triangles({{0, 1, 2}, {0, 2, 1}}), {{0, 1}}, "removal 0", "one fan");
  expect_refused(with_triangles({{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}), {{0, 1}}, "removal 0",
                 "one fan");
  expect_refused(with_triangles({{0, 0, 1}, {1, 2, 0}}), {{0, 1}}, "removal 0", "one fan");
  // Around a tube of three there are circles of three edges without a triangle.
  expect_refused(make_torus(1, 0.4, 8, 3), {{0, 8}}, "removal 0", "in common");
}

TEST(RemovalOrder, RefusesErrorsThatFallOrAreNone) {
  const TriangleMesh grid = make_grid(3, 3);
  expect_refused(grid, {{5, 6, 2}, {9, 8, 1}}, "removal 1", "never fall");
  expect_refused(grid, {{5, 6, -1}}, "removal 0", "never fall");
  for (const float none :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    expect_refused(grid, {{5, 6, none}}, "removal 0", "never fall");
  }
}

// Removals that are taken are those that leave the surface as it is: the replay and a plain check
// agree on every pair of neighbours.
TEST(RemovalReplay, AgreesWithAPlainCheck) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const TriangleMesh mesh =
        seed % 2 ? test::random_mesh(25, 20 + seed, seed) : make_torus(1, 0.4, 5, 3 + seed % 3);
    RemovalReplay replay(mesh);
    test::PlainRemovals plain(mesh);
    Random random(seed);
    for (int i = 0; i < 300; ++i) {
      const auto v = static_cast<std::uint32_t>(random.below(mesh.positions.size()));
      const auto into = static_cast<std::uint32_t>(random.below(mesh.positions.size()));
      const bool legal = plain.legal(v, into);
      EXPECT_EQ(replay.apply({v, into}).has_value(), legal) << seed << ": " << v << " " << into;
      if (legal) plain.remove(v, into);
    }
  }
}

TEST(RemovalOrder, RestsOnlyOnWhatSharesATriangle) {
  // 12 x 2 cells: vertices 14, 18 and 22 are interior and far from each other, 15 is beside 14.
  const TriangleMesh strip = make_grid(12, 2);
  const std::vector<Removal> log{{14, 15}, {18, 19}, {22, 23}, {15, 16}};
  const auto order = RemovalOrder::make(strip, log);
  ASSERT_TRUE(order) << order.error().text();
  for (const std::uint32_t k : {0u, 1u, 2u}) EXPECT_TRUE(order->below(k).empty());
  ASSERT_EQ(order->below(3).size(), 1u);
  EXPECT_EQ(order->below(3)[0], 0u);
  ASSERT_EQ(order->above(0).size(), 1u);
  EXPECT_EQ(order->above(0)[0], 3u);
  EXPECT_TRUE(order->above(1).empty());
}

// An ear shares no triangle with its neighbours: but while it is there, it keeps a corner.
TEST(RemovalOrder, AnEarGoesBeforeTheVertexThatHoldsIt) {
  // The ear 0 on the edge from 1 to 2 of a fan around 3.
  const TriangleMesh mesh = with_triangles({{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {1, 5, 3}});
  const std::vector<Removal> log{{0, 2}, {1, 5}};
  const auto order = RemovalOrder::make(mesh, log);
  ASSERT_TRUE(order) << order.error().text();
  EXPECT_EQ(order->star(0).shape, StarShape::ear);
  ASSERT_EQ(order->below(1).size(), 1u);
  EXPECT_EQ(order->below(1)[0], 0u);
}

}  // namespace
}  // namespace burnish
