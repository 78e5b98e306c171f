#include "burnish/adaptation/sqrt3.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "burnish/core/adjacency.h"
#include "burnish/core/topology.h"
#include "burnish/shapes/shapes.h"
#include "support/random_mesh.h"

namespace burnish {
namespace {

TEST(Sqrt3, WeighsSixNeighboursAsThePaperDoes) {
  TriangleMesh mesh = make_grid(6, 6);
  const std::uint32_t middle = 3 * 7 + 3;
  mesh.positions[middle].z = 9;
  const std::size_t old = mesh.positions.size();
  ASSERT_TRUE(refine_sqrt3(mesh));
  std::map<int, int> of_old, of_new;  // in 18ths of the height
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const float part = mesh.positions[v].z * 2;
    EXPECT_NEAR(part, std::round(part), 1e-5f);
    if (part > 0.5f) ++(v < old ? of_old : of_new)[static_cast<int>(std::round(part))];
  }
  EXPECT_EQ(of_old, (std::map<int, int>{{12, 1}, {1, 6}}));
  EXPECT_EQ(of_new, (std::map<int, int>{{6, 6}}));
}

TEST(Sqrt3, MakesThreeTrianglesOfEach) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    for (TriangleMesh mesh : {test::random_mesh(20, 50, seed), make_grid(3, 3), make_torus()}) {
      const std::size_t before = mesh.triangles.size();
      ASSERT_TRUE(refine_sqrt3(mesh, {2}));
      EXPECT_EQ(mesh.triangles.size(), 9 * before);
    }
  }
}

TEST(Sqrt3, FlipsOldEdgesSoThatVerticesKeepTheirValence) {
  TriangleMesh mesh = make_sphere(1, 0);
  ASSERT_TRUE(refine_sqrt3(mesh, {3}));
  const Adjacency rings = one_rings(mesh);
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    EXPECT_EQ(rings.row(v).size(), v < 12 ? 5u : 6u);
  }
}

TEST(Sqrt3, TwoPassesCutEveryEdgeInThree) {
  TriangleMesh mesh = make_grid(3, 2, 3);
  ASSERT_TRUE(refine_sqrt3(mesh, {2}));
  // The new lattice is the grid of a third, but where boundaries turn: none of their vertices moves
  // along a straight line, and the inner ones are linear in their neighbours.
  TriangleMesh thirds = make_grid(9, 6, 1);
  EXPECT_EQ(mesh.positions.size(), thirds.positions.size());
  EXPECT_EQ(mesh.triangles.size(), thirds.triangles.size());
  const Topology after = topology(mesh);
  EXPECT_EQ(after.boundary_edges, topology(thirds).boundary_edges);
  EXPECT_TRUE(after.oriented());
  EXPECT_EQ(after.euler_number, 1);
}

TEST(Sqrt3, SubdividesABoundaryAsACubicSplineEverySecondPass) {
  TriangleMesh mesh = make_grid(6, 6);
  mesh.positions[3].z = 27;
  TriangleMesh once = mesh;
  ASSERT_TRUE(refine_sqrt3(once));
  for (std::uint32_t v = 0; v < 7; ++v) EXPECT_EQ(once.positions[v], mesh.positions[v]);
  ASSERT_TRUE(refine_sqrt3(mesh, {2}));
  std::map<int, float> along;  // by thirds of x
  for (const Vec3f& p : mesh.positions) {
    if (p.y == 0) along[static_cast<int>(std::lround(3 * p.x))] = p.z;
  }
  const std::map<int, float> expected{{5, 1},   {6, 4},   {7, 10}, {8, 16}, {9, 19},
                                      {10, 16}, {11, 10}, {12, 4}, {13, 1}};
  for (const auto& [x, z] : expected) EXPECT_NEAR(along[x], z, 1e-5f) << x;
  EXPECT_EQ(along[4], 0);
}

TEST(Sqrt3, KeepsTrianglesTogetherOfWhichSeveralSidesAreCreases) {
  TriangleMesh mesh;  // of one that names a vertex twice all edges are
  mesh.positions = {{0, 0, 0}, {1, 0, 0}};
  mesh.triangles = {{0, 0, 1}};
  ASSERT_TRUE(refine_sqrt3(mesh, {2}));
  EXPECT_EQ(topology(mesh).components, 1u);
}

TEST(Sqrt3, GoesToItsLimit) {
  // A vertex and the mean m of its n neighbours become (1 - w) p + w m and 1/3 p + 2/3 m: the limit
  // is (p + 3 w m) / (1 + 3 w), and what is left of p - m after k passes (2/3 - w)^k.
  constexpr int kPasses = 5;
  for (const int n : {4, 5}) {
    TriangleMesh mesh = n == 4 ? make_uv_sphere(1, 4, 2) : make_sphere(1, 0);
    const Vec3d p(mesh.positions[0]);
    Vec3d mean;
    const Adjacency rings = one_rings(mesh);
    for (const std::uint32_t q : rings.row(0)) mean += Vec3d(mesh.positions[q]) / double(n);
    const double w = (4 - 2 * std::cos(2 * std::numbers::pi / n)) / 9;
    const Vec3d limit = (p + mean * (3 * w)) / (1 + 3 * w);
    ASSERT_TRUE(refine_sqrt3(mesh, {kPasses}));
    const double left = norm(p - mean) * std::pow(2.0 / 3 - w, kPasses);
    EXPECT_LT(norm(Vec3d(mesh.positions[0]) - limit), left + kPasses * 1.1e-7) << n;
    EXPECT_GT(norm(p - limit), 10 * (left + kPasses * 1.1e-7)) << n;
  }
}

}  // namespace
}  // namespace burnish
