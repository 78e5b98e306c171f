#include "burnish/adaptation/midpoint.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "burnish/shapes/shapes.h"
#include "support/random_mesh.h"
#include "support/refinement_promises.h"

namespace burnish {
namespace {

/// Twice the area, exact where coordinates are small multiples of a power of two.
Vec3d area_vectors(const TriangleMesh& mesh, double& area) {
  Vec3d sum;
  area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    sum += area_vector(mesh, t);
    area += norm(area_vector(mesh, t));
  }
  return sum;
}

TEST(Midpoint, PutsVerticesInTheMiddleAndNothingElse) {
  TriangleMesh mesh = test::random_mesh(30, 60, 3);
  const TriangleMesh before = mesh;
  ASSERT_TRUE(refine_midpoint(mesh));
  EXPECT_TRUE(std::equal(before.positions.begin(), before.positions.end(), mesh.positions.begin()));
  std::size_t next = before.positions.size();
  for (const auto& [edge, sides] : test::sides_along_edges(before)) {
    const Vec3d a(before.positions[edge[0]]), b(before.positions[edge[1]]);
    EXPECT_EQ(mesh.positions[next++], Vec3f((a + b) / 2.0));
  }
  EXPECT_EQ(next, mesh.positions.size());
}

TEST(Midpoint, KeepsTheSurface) {
  TriangleMesh mesh = make_box({1, 2, 4}, 2);
  double area = 0, refined_area = 0;
  area_vectors(mesh, area);
  ASSERT_TRUE(refine_midpoint(mesh, {3}));
  area_vectors(mesh, refined_area);
  EXPECT_EQ(refined_area,
            area);  // every coordinate is a power of two's multiple: nothing is rounded
  for (const Vec3f& p : mesh.positions) {
    EXPECT_EQ(std::max({std::abs(p.x) * 2, std::abs(p.y), std::abs(p.z) / 2}), 1);
  }
  EXPECT_EQ(mesh.triangles.size(), 48u * 64);
}

TEST(Midpoint, TrianglesBesideTwoOfAZoneAreCutByTheShorterDiagonal) {
  for (const float x : {0.2f, 3.8f}) {  // of the corner in the middle: that side is the shorter one
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {4, 0, 0}, {x, 3, 0}, {-3, 3, 0}, {7, 3, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 2}};
    mesh = test::with_zone(mesh, {0, 0, 0, 1, 1});
    ASSERT_TRUE(refine_midpoint(mesh));
    EXPECT_EQ(mesh.triangles.size(), 11u);
    const auto sides = test::sides_along_edges(mesh);
    const std::uint32_t left = 5, right = 7;  // the middles of the edges 0 2 and 1 2
    EXPECT_EQ(mesh.positions[left], (Vec3f{x / 2, 1.5f, 0}));
    EXPECT_EQ(mesh.positions[right], (Vec3f{2 + x / 2, 1.5f, 0}));
    EXPECT_EQ(sides.count({0, right}), x < 2 ? 1u : 0u);
    EXPECT_EQ(sides.count({1, left}), x < 2 ? 0u : 1u);
  }
}

TEST(Midpoint, TrianglesGetLargerFromAZoneOutwards) {
  // Five passes around one vertex: had a triangle that was cut in two to fit its neighbours been
  // cut again, angles would get smaller with every pass.
  const TriangleMesh before = make_grid(8, 8);
  std::vector<float> weights(before.positions.size(), 0);
  for (const std::uint32_t v : {40u, 41u, 49u}) weights[v] = 1;
  TriangleMesh mesh = test::with_zone(before, weights);
  ASSERT_TRUE(refine_midpoint(mesh, {5}));
  double smallest = 1;  // twice the area by the square of the longest edge
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    double longest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3f along =
          mesh.positions[mesh.triangles[t][i]] - mesh.positions[mesh.triangles[t][(i + 1) % 3]];
      longest = std::max<double>(longest, squared_norm(along));
    }
    smallest = std::min(smallest, norm(area_vector(mesh, t)) / longest);
  }
  // Cut once, a triangle with legs of 1 keeps half of its area, and at worst an edge of sqrt 5 / 2.
  EXPECT_GE(smallest, 0.5 * 0.5 * 0.8);
  EXPECT_EQ(test::sides_along_edges(mesh).size() + 1,
            mesh.positions.size() + mesh.triangles.size() + 0u);
}

}  // namespace
}  // namespace burnish
