#include "burnish/repair/manifold_cuts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "burnish/base/random.h"
#include "burnish/core/topology.h"
#include "burnish/io/geometry_file.h"
#include "burnish/shapes/shapes.h"
#include "support/test_data.h"

namespace burnish {
namespace {

void expect_oriented_manifold(const TriangleMesh& mesh) {
  const Topology t = topology(mesh);
  EXPECT_EQ(t.non_manifold_edges, 0u);
  EXPECT_EQ(t.flipped_edges, 0u);
  EXPECT_EQ(t.non_manifold_vertices, 0u);
  EXPECT_EQ(t.degenerate_triangles, 0u);
  EXPECT_EQ(t.duplicate_triangles, 0u);
}

/// The corners of all triangles as places: what a cut leaves as it is.
std::vector<Vec3f> places(const TriangleMesh& mesh) {
  std::vector<Vec3f> places;
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) places.push_back(mesh.positions[v]);
  }
  return places;
}

void add_tetrahedron(TriangleMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                     std::uint32_t d) {
  for (const Triangle& t : {Triangle{a, b, c}, {a, d, b}, {b, d, c}, {c, d, a}}) {
    mesh.triangles.push_back(t);
  }
}

/// Two tetrahedra on either side of the edge 0-1, which is all that they share.
TriangleMesh two_that_share_an_edge() {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 1}, {1, 1, 0}, {1, -1, 0}, {-1, 1, 0}, {-1, -1, 0}};
  add_tetrahedron(mesh, 0, 1, 2, 3);
  add_tetrahedron(mesh, 0, 1, 5, 4);
  return mesh;
}

TEST(MakeManifold, PartsSolidsThatTouchInAnEdgeAndKeepsThemClosed) {
  TriangleMesh mesh = two_that_share_an_edge();
  ASSERT_EQ(topology(mesh).non_manifold_edges, 1u);
  const std::vector<Vec3f> before = places(mesh);
  const auto report = make_manifold(mesh);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->singular_edges, 1u);
  EXPECT_EQ(report->added_vertices, 2u);
  EXPECT_EQ(places(mesh), before);
  expect_oriented_manifold(mesh);
  EXPECT_TRUE(topology(mesh).closed());
  EXPECT_EQ(topology(mesh).components, 2u);
}

TEST(MakeManifold, CutsAllPagesOfABook) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  mesh.attributes.sigma = {1, 2, 3, 4, 5};
  const auto report = make_manifold(mesh);
  ASSERT_TRUE(report);
  EXPECT_EQ(topology(mesh).components, 3u);
  expect_oriented_manifold(mesh);
  EXPECT_EQ(mesh.attributes.sigma, (std::vector<float>{1, 2, 3, 4, 5, 1, 2, 1, 2}));
}

TEST(MakeManifold, PartsFansThatTouchInAVertex) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 4}};
  ASSERT_TRUE(make_manifold(mesh));
  EXPECT_EQ(mesh.positions.size(), 6u);
  expect_oriented_manifold(mesh);
}

TEST(MakeManifold, CutsAMoebiusStripOnce) {
  constexpr std::uint32_t kAround = 12;
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < kAround; ++i) {
    const double turn = 2 * 3.141592653589793 * i / kAround;
    for (const double side : {-0.3, 0.3}) {
      const double radius = 1 + side * std::cos(turn / 2);
      mesh.positions.push_back({static_cast<float>(radius * std::cos(turn)),
                                static_cast<float>(radius * std::sin(turn)),
                                static_cast<float>(side * std::sin(turn / 2))});
    }
    const std::uint32_t a = 2 * i, b = a + 1, last = i + 1 == kAround;
    const std::uint32_t c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({b, c, d});
  }
  ASSERT_EQ(topology(mesh).flipped_edges, 1u);
  const auto report = make_manifold(mesh);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->flipped_edges, 1u);
  expect_oriented_manifold(mesh);
  EXPECT_EQ(topology(mesh).components, 1u);
}

TEST(MakeManifold, TakesAwaySheetsThatLieOnEachOther) {
  TriangleMesh mesh = make_torus(12, 8);
  const TriangleMesh before = mesh;
  const auto [a, b, c] = mesh.triangles[20];
  mesh.triangles.insert(mesh.triangles.begin(), {{b, a, 90}, {a, b, 90}});  // a fin of no thickness
  mesh.triangles.push_back({b, c, a});                                      // as it is, once more
  const auto report = make_manifold(mesh);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->duplicate_triangles, 3u);
  EXPECT_EQ(mesh, before);
}

TEST(MakeManifold, LeavesAManifoldAsItIs) {
  TriangleMesh mesh = make_torus(12, 8);
  mesh.positions.push_back({9, 9, 9});  // of no triangle
  const TriangleMesh before = mesh;
  ASSERT_TRUE(make_manifold(mesh));
  EXPECT_EQ(mesh, before);
}

TEST(MakeManifold, MakesOneOfAnySoup) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Random random(seed, 1);
    TriangleMesh mesh;
    for (int v = 0; v < 12; ++v) {
      Vec3f p;
      for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = static_cast<float>(random.below(3));
      mesh.positions.push_back(p);
    }
    for (std::uint64_t t = 5 + random.below(60); t > 0; --t) {
      Triangle triangle;
      for (std::uint32_t& v : triangle) v = static_cast<std::uint32_t>(random.below(12));
      mesh.triangles.push_back(triangle);
    }
    const std::size_t triangles = mesh.triangles.size();
    const auto report = make_manifold(mesh, {.keep_solids = seed % 2 == 0});
    ASSERT_TRUE(report);
    EXPECT_EQ(mesh.triangles.size(),
              triangles - report->degenerate_triangles - report->duplicate_triangles);
    expect_oriented_manifold(mesh);
    EXPECT_TRUE(check(mesh));
    if (HasFailure()) FAIL() << "seed " << seed;
  }
}

TEST(MakeManifold, ClosesTheBuddhaWhoseSheetsTouch) {
  BURNISH_DATA_OR_SKIP(file, "stanford/buddha_photon.obj");
  auto read = read_mesh(file);
  ASSERT_TRUE(read);
  const auto report = make_manifold(*read);
  ASSERT_TRUE(report);
  expect_oriented_manifold(*read);
  EXPECT_TRUE(topology(*read).closed());
}

}  // namespace
}  // namespace burnish
