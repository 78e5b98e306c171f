#include "burnish/core/adjacency.h"

#include <gtest/gtest.h>

#include <set>

#include "burnish/core/edges.h"
#include "burnish/shapes/shapes.h"

namespace burnish {
namespace {

std::vector<std::uint32_t> row(const Adjacency& lists, std::size_t i) {
  return {lists.row(i).begin(), lists.row(i).end()};
}

/// Two triangles over a square, and a vertex that nothing uses.
TriangleMesh square() {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {9, 9, 9}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

TEST(Adjacency, ListsTrianglesAndNeighboursRising) {
  const Adjacency triangles = triangles_of_vertices(square()), rings = one_rings(square());
  ASSERT_EQ(triangles.size(), 5u);
  EXPECT_EQ(row(triangles, 0), (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(row(triangles, 3), (std::vector<std::uint32_t>{1}));
  EXPECT_EQ(row(rings, 0), (std::vector<std::uint32_t>{1, 2, 3}));
  EXPECT_EQ(row(rings, 1), (std::vector<std::uint32_t>{0, 2}));
  EXPECT_TRUE(row(rings, 4).empty());
}

TEST(Adjacency, ATriangleThatNamesAVertexTwiceCountsOnce) {
  TriangleMesh mesh = square();
  mesh.triangles.push_back({1, 1, 4});
  EXPECT_EQ(row(triangles_of_vertices(mesh), 1), (std::vector<std::uint32_t>{0, 2}));
  EXPECT_EQ(row(one_rings(mesh), 1), (std::vector<std::uint32_t>{0, 2, 4}));
}

TEST(Adjacency, OfAClosedMeshHasEveryEdgeTwice) {
  const TriangleMesh mesh = make_torus(1, 0.4, 24, 12);
  const Adjacency rings = one_rings(mesh);
  EXPECT_EQ(rings.items().size(), 2 * edges(mesh).size());
  for (std::uint32_t v = 0; v < rings.size(); ++v) {
    for (const std::uint32_t w : rings.row(v)) {
      const auto back = rings.row(w);
      EXPECT_NE(std::find(back.begin(), back.end(), v), back.end());
      EXPECT_NE(w, v);
    }
  }
  for (const bool on_boundary : boundary_vertices(mesh)) EXPECT_FALSE(on_boundary);
}

TEST(Adjacency, BoundaryNeighboursGoRoundTheBoundaryOnly) {
  const TriangleMesh grid = make_grid(5, 4);
  const Adjacency along = boundary_neighbours(grid);
  const std::vector<bool> on_boundary = boundary_vertices(grid);
  std::size_t count = 0;
  for (std::size_t v = 0; v < along.size(); ++v) {
    count += on_boundary[v];
    EXPECT_EQ(along.row(v).size(), on_boundary[v] ? 2u : 0u);
    for (const std::uint32_t w : along.row(v)) EXPECT_TRUE(on_boundary[w]);
  }
  EXPECT_EQ(count, 2u * (5 + 4));
}

TEST(Edges, AreListedOnceInOrderWithTheirTriangles) {
  const std::vector<Edge> all = edges(square());
  ASSERT_EQ(all.size(), 5u);
  for (std::size_t i = 1; i < all.size(); ++i) EXPECT_LT(all[i - 1].vertices, all[i].vertices);
  EXPECT_EQ(all[1].vertices, (std::array<std::uint32_t, 2>{0, 2}));
  EXPECT_EQ(all[1].triangles, 2u);
  EXPECT_EQ(all[1].forward, 1u);
  EXPECT_FALSE(all[1].flipped());
  EXPECT_TRUE(all[0].boundary());
}

TEST(Edges, TellWhereOrientationsDisagree) {
  TriangleMesh mesh = square();
  std::swap(mesh.triangles[1][0], mesh.triangles[1][1]);
  EXPECT_TRUE(edges(mesh)[1].flipped());
}

}  // namespace
}  // namespace burnish
