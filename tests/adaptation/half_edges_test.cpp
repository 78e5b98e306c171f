#include "burnish/adaptation/half_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "burnish/base/random.h"
#include "burnish/core/topology.h"
#include "burnish/shapes/shapes.h"
#include "support/random_mesh.h"

namespace burnish {
namespace {

std::vector<Triangle> live_triangles(const HalfEdges& half_edges) {
  std::vector<Triangle> live;
  for (std::size_t t = 0; t < half_edges.triangles(); ++t) {
    if (half_edges.is_live(t)) live.push_back(half_edges.triangle(t));
  }
  return live;
}

/// What the twins, the first half-edges and the kinds must be, told by the triangles alone.
void expect_sound(const HalfEdges& half_edges) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const auto& [a, b, c] : live_triangles(half_edges)) {
    for (const auto& side : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) ++sides[side];
  }
  std::map<std::uint32_t, int> leaving;
  for (const auto& [side, count] : sides) leaving[side.first] += count;
  for (HalfEdges::Index h = 0; h < 3 * half_edges.triangles(); ++h) {
    if (!half_edges.is_live(h / 3)) continue;
    const HalfEdges::Index a = half_edges.origin(h), b = half_edges.head(h);
    const bool opposite = sides.count({b, a}) > 0;
    const HalfEdges::Index twin = half_edges.twin(h);
    if (half_edges.kind(a) != HalfEdges::Kind::locked &&
        half_edges.kind(b) != HalfEdges::Kind::locked) {
      ASSERT_EQ(twin != HalfEdges::kNone, opposite) << a << " " << b;
    }
    if (twin != HalfEdges::kNone) {
      ASSERT_TRUE(half_edges.is_live(twin / 3));
      ASSERT_EQ(half_edges.twin(twin), h);
      ASSERT_EQ(half_edges.origin(twin), b);
      ASSERT_EQ(half_edges.head(twin), a);
    }
  }
  for (const auto& [v, count] : leaving) {
    if (half_edges.kind(v) == HalfEdges::Kind::locked) continue;
    int met = 0;
    bool open = false;
    half_edges.for_each_from(v, [&, vertex = v](HalfEdges::Index h) {
      EXPECT_EQ(half_edges.origin(h), vertex);
      open |= half_edges.twin(h) == HalfEdges::kNone;
      ++met;
    });
    ASSERT_EQ(met, count);
    ASSERT_EQ(open, half_edges.kind(v) == HalfEdges::Kind::boundary);
  }
}

/// Collapses edges at random as long as any can.
void collapse_at_random(const TriangleMesh& mesh, std::uint64_t seed) {
  HalfEdges half_edges(mesh.positions.size(), mesh.triangles);
  expect_sound(half_edges);
  const Topology before = topology(mesh);
  Random random(seed);
  int failures = 0;
  for (int made = 0; failures < 200;) {
    const auto h = static_cast<HalfEdges::Index>(
        random.below(3 * std::max<std::size_t>(1, half_edges.triangles())));
    if (half_edges.triangles() == 0 || !half_edges.is_live(h / 3) ||
        !half_edges.ends_that_may_go(h).possible() || !half_edges.keeps_surface(h)) {
      ++failures;
      continue;
    }
    failures = 0;
    const auto may = half_edges.ends_that_may_go(h);
    half_edges.collapse(h, may.head_may_go && (!may.origin_may_go || random.below(2) == 1));
    if (++made % 7 == 0) half_edges.compact();
    ASSERT_NO_FATAL_FAILURE(expect_sound(half_edges));
    TriangleMesh now{mesh.positions, live_triangles(half_edges), {}, {}, {}};
    const Topology after = topology(now);
    ASSERT_EQ(now.triangles.size(), half_edges.live_triangles());
    ASSERT_EQ(after.euler_number, before.euler_number);
    ASSERT_EQ(after.boundary_loops, before.boundary_loops);
    ASSERT_EQ(after.components, before.components);
    ASSERT_EQ(after.non_manifold_edges, before.non_manifold_edges);
    ASSERT_EQ(after.flipped_edges, before.flipped_edges);
    ASSERT_EQ(after.degenerate_triangles, before.degenerate_triangles);
    ASSERT_EQ(after.duplicate_triangles, before.duplicate_triangles);
  }
}

TEST(HalfEdges, CollapsesKeepWhatTheSurfaceIs) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    collapse_at_random(make_grid(7, 6), seed);
    collapse_at_random(make_uv_sphere(1, 10, 6), seed);
    collapse_at_random(make_torus(1, 0.4, 7, 5), seed);
  }
}

TEST(HalfEdges, CollapsesLeaveAloneWhatIsNoSurface) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    collapse_at_random(test::random_mesh(12, 3 + seed, seed), seed);
  }
}

TEST(HalfEdges, ATetrahedronAndATriangleStay) {
  const std::vector<Triangle> tetrahedron{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  HalfEdges solid(4, tetrahedron);
  for (HalfEdges::Index h = 0; h < 12; ++h) EXPECT_FALSE(solid.keeps_surface(h));
  HalfEdges single(3, {{0, 1, 2}});
  for (HalfEdges::Index h = 0; h < 3; ++h) EXPECT_FALSE(single.keeps_surface(h));
}

}  // namespace
}  // namespace burnish
