#include "burnish/repair/small_components.h"

#include <gtest/gtest.h>

#include "burnish/shapes/shapes.h"

namespace burnish {
namespace {

/// Two triangulated grids that touch nowhere, and one triangle far from both.
TriangleMesh scene() {
  TriangleMesh mesh = make_grid(6, 6);
  const TriangleMesh small = make_grid(2, 2);
  const auto append = [&](const TriangleMesh& part, float x) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3f& p : part.positions) mesh.positions.push_back(p + Vec3f{x, 0, 0});
    for (const auto& [a, b, c] : part.triangles)
      mesh.triangles.push_back({a + first, b + first, c + first});
  };
  append(small, 50);
  TriangleMesh speck;
  speck.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  speck.triangles = {{0, 1, 2}};
  append(speck, 100);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    mesh.attributes.sigma.push_back(static_cast<float>(v));
  return mesh;
}

TEST(SmallComponents, RemovesWhatHasTooFewTrianglesWithItsVertices) {
  TriangleMesh mesh = scene();
  const std::size_t triangles = mesh.triangles.size(), vertices = mesh.positions.size();
  const auto report = remove_small_components(mesh, {.min_triangles = 2});
  ASSERT_TRUE(report);
  EXPECT_EQ(report->components, 3u);
  EXPECT_EQ(report->removed_components, 1u);
  EXPECT_EQ(mesh.triangles.size(), triangles - 1);
  EXPECT_EQ(mesh.positions.size(), vertices - 3);
  EXPECT_EQ(mesh.attributes.sigma.size(), mesh.positions.size());
  EXPECT_TRUE(check(mesh));
}

TEST(SmallComponents, LargestOnlyLeavesOne) {
  TriangleMesh mesh = scene();
  const TriangleMesh largest = make_grid(6, 6);
  ASSERT_TRUE(remove_small_components(mesh, {.min_triangles = 0, .largest_only = true}));
  EXPECT_EQ(mesh.positions, largest.positions);
  EXPECT_EQ(mesh.triangles, largest.triangles);
}

TEST(SmallComponents, ZeroKeepsEverythingButUnusedVertices) {
  TriangleMesh mesh = scene();
  const TriangleMesh before = mesh;
  ASSERT_TRUE(remove_small_components(mesh, {.min_triangles = 0}));
  EXPECT_EQ(mesh, before);
}

}  // namespace
}  // namespace burnish
