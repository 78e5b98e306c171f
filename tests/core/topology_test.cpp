#include "burnish/core/topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "burnish/core/adjacency.h"
#include "burnish/core/edges.h"
#include "burnish/shapes/shapes.h"
#include "support/random_mesh.h"

namespace burnish {
namespace {

using test::random_mesh;
using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// How many triangles use each undirected edge.
std::map<Pair, std::size_t> plain_edges(const TriangleMesh& mesh) {
  std::map<Pair, std::size_t> count;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (t[i] != t[(i + 1) % 3]) ++count[std::minmax(t[i], t[(i + 1) % 3])];
    }
  }
  return count;
}

TEST(Adjacency, AgreesWithPlainSetsOnAnyMesh) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    const TriangleMesh mesh = random_mesh(15 + 3 * seed, 10 * seed, seed);
    const auto count = plain_edges(mesh);
    std::vector<std::set<std::uint32_t>> rings(mesh.positions.size()), along(mesh.positions.size());
    for (const auto& [edge, triangles] : count) {
      rings[edge.first].insert(edge.second);
      rings[edge.second].insert(edge.first);
      if (triangles == 2) continue;
      along[edge.first].insert(edge.second);
      along[edge.second].insert(edge.first);
    }
    const Adjacency ours = one_rings(mesh), ours_along = boundary_neighbours(mesh);
    const std::vector<bool> on_boundary = boundary_vertices(mesh);
    ASSERT_EQ(ours.size(), rings.size());
    for (std::size_t v = 0; v < rings.size(); ++v) {
      EXPECT_TRUE(std::ranges::equal(ours.row(v), rings[v]));
      EXPECT_TRUE(std::ranges::equal(ours_along.row(v), along[v]));
      EXPECT_EQ(on_boundary[v], !along[v].empty());
    }
    const std::vector<Edge> all = edges(mesh);
    ASSERT_EQ(all.size(), count.size());
    for (const Edge& edge : all) {
      EXPECT_EQ(edge.triangles, count.at({edge.vertices[0], edge.vertices[1]}));
    }
  }
}

TEST(Adjacency, TrianglesOfVerticesListsEachOnce) {
  TriangleMesh mesh;
  mesh.positions.resize(4);
  mesh.triangles = {{0, 1, 2}, {2, 1, 3}, {1, 1, 1}, {0, 0, 1}};
  const Adjacency rows = triangles_of_vertices(mesh);
  EXPECT_TRUE(std::ranges::equal(rows.row(0), std::vector<std::uint32_t>{0, 3}));
  EXPECT_TRUE(std::ranges::equal(rows.row(1), std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_TRUE(std::ranges::equal(rows.row(3), std::vector<std::uint32_t>{1}));
}

TEST(Topology, OfKnownShapes) {
  const Topology grid = topology(make_grid(3, 2));
  EXPECT_EQ(grid.edges, 23u);
  EXPECT_EQ(grid.boundary_edges, 10u);
  EXPECT_EQ(grid.boundary_loops, 1u);
  EXPECT_EQ(grid.components, 1u);
  EXPECT_EQ(grid.euler_number, 1);
  const Topology torus = topology(make_torus());
  EXPECT_TRUE(torus.closed());
  EXPECT_TRUE(torus.oriented());
  EXPECT_EQ(torus.euler_number, 0);
}

TEST(Topology, SeesEveryOddity) {
  TriangleMesh mesh;
  mesh.positions.resize(12);
  mesh.triangles = {{0, 1, 2},  {1, 0, 3}, {0, 1, 4},  // three at the edge 0 1
                    {5, 6, 7},  {5, 6, 8},             // both run from 5 to 6
                    {5, 9, 10},                        // a second fan at 5
                    {10, 5, 9},                        // the same triangle again
                    {6, 6, 6}};
  const Topology t = topology(mesh);
  EXPECT_EQ(t.non_manifold_edges, 1u);
  EXPECT_EQ(t.non_manifold_vertices, 1u);
  EXPECT_EQ(t.duplicate_triangles, 1u);
  EXPECT_EQ(t.degenerate_triangles, 1u);
  EXPECT_EQ(t.unused_vertices, 1u);
  EXPECT_GE(t.flipped_edges, 1u);
  EXPECT_FALSE(t.oriented());
  EXPECT_FALSE(t.closed());
  EXPECT_EQ(t.components, 4u);
}

TEST(Topology, ComponentsAreNumberedInOrder) {
  TriangleMesh mesh = make_grid(1, 1);
  const TriangleMesh more = make_grid(1, 1);
  for (const Triangle& t : more.triangles) mesh.triangles.push_back({t[0] + 4, t[1] + 4, t[2] + 4});
  mesh.positions.resize(8);
  std::swap(mesh.triangles[1], mesh.triangles[2]);
  EXPECT_EQ(triangle_components(mesh), (std::vector<std::uint32_t>{0, 1, 0, 1}));
}

}  // namespace
}  // namespace burnish
