#include "burnish/adaptation/loop.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "burnish/core/adjacency.h"
#include "burnish/core/edges.h"
#include "burnish/shapes/shapes.h"

namespace burnish {
namespace {

/// How many vertices of the mesh have which height, but for those of none.
std::map<float, int> heights(const TriangleMesh& mesh) {
  std::map<float, int> counts;
  for (const Vec3f& p : mesh.positions) {
    if (p.z != 0) ++counts[p.z];
  }
  return counts;
}

TEST(Loop, WeighsSixNeighboursAsTheBoxSplineDoes) {
  TriangleMesh mesh = make_grid(6, 6);
  mesh.positions[3 * 7 + 3].z = 1;
  ASSERT_TRUE(refine_loop(mesh));
  EXPECT_EQ(mesh.positions[3 * 7 + 3].z, 5.f / 8);
  const std::map<float, int> expected{{1.f / 16, 6}, {1.f / 8, 6}, {3.f / 8, 6}, {5.f / 8, 1}};
  EXPECT_EQ(heights(mesh), expected);
}

TEST(Loop, SubdividesABoundaryAsACubicSpline) {
  TriangleMesh mesh = make_grid(6, 6);
  mesh.positions[3].z = 1;
  const TriangleMesh before = mesh;
  ASSERT_TRUE(refine_loop(mesh));
  const auto height = [&](float x) {
    for (const Vec3f& p : mesh.positions) {
      if (p.y == 0 && p.x == x) return p.z;
    }
    return -1.f;
  };
  EXPECT_EQ(height(3), 3.f / 4);
  EXPECT_EQ(height(2.5), 1.f / 2);
  EXPECT_EQ(height(4), 1.f / 8);
  EXPECT_EQ(height(4.5), 0);
  // What lies inside does not matter.
  TriangleMesh other = before;
  other.positions[8 + 1].z = 5;
  ASSERT_TRUE(refine_loop(other));
  for (const Edge& edge : edges(mesh)) {
    if (!edge.boundary()) continue;
    for (const std::uint32_t v : edge.vertices) EXPECT_EQ(mesh.positions[v], other.positions[v]);
  }
}

TEST(Loop, CornersOfNonManifoldEdgesStay) {
  TriangleMesh mesh;  // three wings: the ends of their common edge lie on three creases
  mesh.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  const TriangleMesh before = mesh;
  ASSERT_TRUE(refine_loop(mesh));
  EXPECT_EQ(mesh.positions[0], before.positions[0]);
  EXPECT_EQ(mesh.positions[1], before.positions[1]);
  EXPECT_EQ(mesh.positions[5], (Vec3f{0, 0, 0.5f}));
  EXPECT_EQ(mesh.triangles.size(), 12u);
}

TEST(Loop, GoesToItsLimit) {
  // A vertex and the mean m of its n neighbours become (1 - w) p + w m and 3/8 p + 5/8 m, of which
  // p + 8/3 w m is kept but for its factor: the limit is (p + 8/3 w m) / (1 + 8/3 w), and what is
  // left of p - m after k passes (5/8 - w)^k.
  constexpr int kPasses = 4;
  for (const int n : {4, 5, 6}) {
    TriangleMesh mesh = n == 4 ? make_uv_sphere(1, 4, 2) : make_sphere(1, n == 5 ? 0 : 1);
    const Adjacency rings = one_rings(mesh);
    std::uint32_t v = 0;
    while (rings.row(v).size() != static_cast<std::size_t>(n)) ++v;
    const Vec3d p(mesh.positions[v]);
    Vec3d mean;
    for (const std::uint32_t q : rings.row(v)) mean += Vec3d(mesh.positions[q]) / double(n);
    const double part = 3.0 / 8 + std::cos(2 * std::numbers::pi / n) / 4, w = 5.0 / 8 - part * part;
    const Vec3d limit = (p + mean * (8 * w / 3)) / (1 + 8 * w / 3);
    ASSERT_TRUE(refine_loop(mesh, {kPasses}));
    const double left = norm(p - mean) * std::pow(5.0 / 8 - w, kPasses);
    // Each pass rounds to floats, 6e-8 of 1 along three axes.
    EXPECT_LT(norm(Vec3d(mesh.positions[v]) - limit), left + kPasses * 1.1e-7) << n;
    EXPECT_GT(norm(p - limit), 10 * (left + kPasses * 1.1e-7)) << n;
  }
}

TEST(Loop, MakesFourTrianglesOfEachAndSixNeighboursOfNewVertices) {
  TriangleMesh mesh = make_sphere(1, 0);
  ASSERT_TRUE(refine_loop(mesh, {2}));
  EXPECT_EQ(mesh.triangles.size(), 20u * 16);
  const Adjacency rings = one_rings(mesh);
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    EXPECT_EQ(rings.row(v).size(), v < 12 ? 5u : 6u);
  }
}

TEST(Loop, SigmaIsTheMeanOfWhatAVertexIsMadeOfWhereThatIsLarger) {
  TriangleMesh mesh = make_grid(6, 6);
  mesh.attributes.sigma.assign(mesh.positions.size(), 1);
  const std::uint32_t bad = 3 * 7 + 3, neighbour = bad + 1;
  mesh.attributes.sigma[bad] = 17;
  ASSERT_TRUE(refine_loop(mesh));
  EXPECT_EQ(mesh.attributes.sigma[bad], 17);
  EXPECT_EQ(mesh.attributes.sigma[neighbour], 1 + 16.f / 16);
  std::map<float, int> of_new;
  for (std::size_t v = 49; v < mesh.positions.size(); ++v) ++of_new[mesh.attributes.sigma[v]];
  EXPECT_EQ(of_new[17], 6);            // beside it: the larger parent's
  EXPECT_EQ(of_new[1 + 16.f / 8], 6);  // across from it: it has an eighth in them
  EXPECT_EQ(of_new.size(), 3u);
}

TEST(Loop, LeavesTheSurfaceAroundAZone) {
  TriangleMesh mesh = make_sphere(1, 2);
  const std::size_t old = mesh.positions.size();
  std::vector<float> weights(old, 0);
  weights[20] = 1;
  mesh.attributes.channels.push_back({std::string(kRefinement), weights});
  const TriangleMesh before = mesh;
  ASSERT_TRUE(refine_loop(mesh));
  std::size_t between = 0;  // new ones of edges whose ends are not in the zone
  for (std::size_t v = old; v < mesh.positions.size(); ++v) {
    for (const Edge& edge : edges(before)) {
      const auto [a, b] = edge.vertices;
      if (a == 20 || b == 20) continue;
      between += mesh.positions[v] ==
                 Vec3f((Vec3d(before.positions[a]) + Vec3d(before.positions[b])) / 2.0);
    }
  }
  EXPECT_EQ(between, one_rings(before).row(20).size());
}

TEST(Loop, SaysWhatItDid) {
  TriangleMesh mesh = make_grid(2, 2);
  mesh.positions[4].z = 1;
  const auto report = refine_loop(mesh);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->new_vertices, 16u);
  EXPECT_EQ(report->new_triangles, 24u);
  EXPECT_EQ(report->moved_vertices, 5u);  // the middle, and the four corners get rounder
  EXPECT_EQ(report->max_move, 3.0 / 8);
  EXPECT_GT(report->longest_edge, 0.5);
  EXPECT_LT(report->longest_edge, 1);
}

}  // namespace
}  // namespace burnish
