#include "burnish/core/topology.h"

#include <gtest/gtest.h>

#include "burnish/core/disjoint_sets.h"
#include "burnish/shapes/shapes.h"

namespace burnish {
namespace {

TEST(Topology, OfASphereIsThatOfASphere) {
  const Topology t = topology(make_sphere(1, 2));
  EXPECT_EQ(t.euler_number, 2);
  EXPECT_EQ(t.edges, 480u);
  EXPECT_EQ(t.components, 1u);
  EXPECT_TRUE(t.closed());
  EXPECT_TRUE(t.oriented());
  EXPECT_EQ(t.non_manifold_vertices, 0u);
  EXPECT_EQ(t.boundary_loops, 0u);
}

TEST(Topology, OfATorusHasEulerNumberZero) {
  EXPECT_EQ(topology(make_torus()).euler_number, 0);
}

TEST(Topology, OfAGridHasOneBoundary) {
  const Topology t = topology(make_grid(6, 3));
  EXPECT_EQ(t.euler_number, 1);
  EXPECT_EQ(t.boundary_edges, 18u);
  EXPECT_EQ(t.boundary_loops, 1u);
}

/// Triangles over the edge from vertex 0 to vertex 1.
TriangleMesh book(std::uint32_t pages) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 1}};
  for (std::uint32_t i = 0; i < pages; ++i) {
    mesh.positions.push_back({1, static_cast<float>(i), 0});
    mesh.triangles.push_back({0, 1, 2 + i});
  }
  return mesh;
}

TEST(Topology, CountsEdgesOfThreeTriangles) {
  const Topology t = topology(book(3));
  EXPECT_EQ(t.non_manifold_edges, 1u);
  EXPECT_FALSE(t.edge_manifold());
  EXPECT_EQ(topology(book(2)).non_manifold_edges, 0u);
}

TEST(Topology, CountsEdgesWhoseTrianglesDisagree) {
  EXPECT_EQ(topology(book(2)).flipped_edges, 1u);
  EXPECT_FALSE(topology(book(2)).oriented());
}

TEST(Topology, CountsVerticesOfTwoFans) {
  TriangleMesh bow_tie;
  bow_tie.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
  bow_tie.triangles = {{0, 1, 2}, {0, 3, 4}};
  const Topology t = topology(bow_tie);
  EXPECT_EQ(t.non_manifold_vertices, 1u);
  EXPECT_EQ(t.components, 2u);
}

TEST(Topology, CountsDegenerateAndDuplicateTrianglesAndUnusedVertices) {
  TriangleMesh mesh = make_grid(2, 2);
  mesh.triangles.push_back(mesh.triangles[3]);
  std::rotate(mesh.triangles.back().begin(), mesh.triangles.back().begin() + 1,
              mesh.triangles.back().end());
  mesh.triangles.push_back({0, 0, 1});
  mesh.positions.push_back({7, 7, 7});
  const Topology t = topology(mesh);
  EXPECT_EQ(t.duplicate_triangles, 1u);
  EXPECT_EQ(t.degenerate_triangles, 1u);
  EXPECT_EQ(t.unused_vertices, 1u);
}

TEST(Topology, OfNothingIsNothing) {
  const Topology t = topology({});
  EXPECT_EQ(t.edges, 0u);
  EXPECT_EQ(t.components, 0u);
  EXPECT_EQ(t.euler_number, 0);
}

TEST(TriangleComponents, AreNumberedByTheirFirstTriangles) {
  TriangleMesh mesh;
  mesh.positions.resize(9);
  mesh.triangles = {{6, 7, 8}, {0, 1, 2}, {1, 3, 2}, {4, 5, 6}};
  EXPECT_EQ(triangle_components(mesh), (std::vector<std::uint32_t>{0, 1, 1, 2}));
}

TEST(DisjointSets, AreNamedAfterTheirSmallestMemberWhateverTheOrder) {
  DisjointSets sets(6);
  EXPECT_TRUE(sets.unite(5, 3));
  EXPECT_TRUE(sets.unite(4, 5));
  EXPECT_FALSE(sets.unite(3, 4));
  EXPECT_TRUE(sets.unite(3, 1));
  for (const std::uint32_t i : {1u, 3u, 4u, 5u}) EXPECT_EQ(sets.find(i), 1u);
  EXPECT_EQ(sets.find(0), 0u);
  EXPECT_EQ(sets.find(2), 2u);
}

}  // namespace
}  // namespace burnish
