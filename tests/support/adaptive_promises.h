#pragma once

#include <cstdio>
#include <cstdlib>
#include <span>

#include "burnish/adaptation/adaptive_mesh.h"
#include "burnish/adaptation/point_removal.h"
#include "burnish/core/topology.h"
#include "support/plain_removals.h"

namespace burnish::test {

/// What removals leave of how a mesh hangs together, whatever else it is.
struct SurfaceKind {
  std::int64_t euler_number = 0;
  std::size_t boundary_loops = 0, components = 0, non_manifold_edges = 0, non_manifold_vertices = 0,
              degenerate_triangles = 0, duplicate_triangles = 0, unused_vertices = 0;
  bool oriented = false;

  explicit SurfaceKind(const TriangleMesh& mesh) {
    const Topology t = topology(mesh);
    euler_number = t.euler_number;
    boundary_loops = t.boundary_loops;
    components = t.components;
    non_manifold_edges = t.non_manifold_edges;
    non_manifold_vertices = t.non_manifold_vertices;
    degenerate_triangles = t.degenerate_triangles;
    duplicate_triangles = t.duplicate_triangles;
    unused_vertices = t.unused_vertices;
    oriented = t.flipped_edges == 0;
  }
  /// Whether this may have come of a mesh of the kind `original`: the same, and no edge has turned.
  bool comes_of(SurfaceKind original) const {
    original.oriented = oriented || original.oriented;
    return *this == original;
  }
  friend bool operator==(const SurfaceKind&, const SurfaceKind&) = default;
};

/// Calls one operation of `adaptive`; `random` says which and where: regions are balls around a
/// vertex of `original`.
inline void random_operation(AdaptiveMesh& adaptive, const TriangleMesh& original, double extent,
                             Random& random) {
  const Vec3d centre(original.positions[random.below(original.positions.size())]);
  const double size = random.uniform();
  const double radius = extent * size * size;
  const PointTest inside = [&](const Vec3d& p) {
    return squared_norm(p - original.frame.origin - centre) <= radius * radius;
  };
  const PointTest outside = [&](const Vec3d& p) { return !inside(p); };
  const double error = random.uniform(0, 2 * adaptive.error() + 1e-4);
  const std::uint64_t which = random.below(16);
  Result<void> done;
  if (which < 4) done = adaptive.refine(inside);
  if (which == 4) done = adaptive.refine_to_error(inside, error);
  if (which == 5) done = adaptive.refine(outside);
  if (which >= 6 && which < 12) done = adaptive.reduce(inside);
  if (which == 12) done = adaptive.reduce_to_error(outside, error);
  if (which == 13) adaptive.to_error(error);
  if (which == 14) adaptive.to_triangles(random.below(original.triangles.size() + 1));
  if (which == 15) {
    done =
        adaptive.focus(inside, {.outside_triangles = random.below(original.triangles.size() + 1)});
  }
  if (!done) std::abort();
}

/// A rough surface over a square lattice, some cells left out and some cut in two the other way,
/// with heights that are small whole numbers; every other one bent so that places coincide.
inline TriangleMesh lattice_mesh(std::span<const std::uint8_t> bytes) {
  TriangleMesh mesh;
  const auto byte = [&](std::size_t i) {
    return bytes.empty() ? 0u : bytes[i % bytes.size()] + 0u;
  };
  const std::uint32_t side = 3 + byte(0) % 8;
  const bool round = byte(1) & 1, fold = byte(1) & 2;
  for (std::uint32_t i = 0; i < side * side; ++i) {
    const std::uint32_t x = i % side, y = i / side;
    mesh.positions.push_back({static_cast<float>(fold ? x * x % 7 : x), static_cast<float>(y),
                              static_cast<float>(byte(2 + i) % 10)});
  }
  const std::uint32_t cells = round ? side : side - 1;
  for (std::uint32_t y = 0; y < cells; ++y) {
    for (std::uint32_t x = 0; x < cells; ++x) {
      const std::uint32_t choice = byte(3 + 7 * (y * cells + x));
      const std::uint32_t right = (x + 1) % side, up = (y + 1) % side;
      const std::uint32_t a = y * side + x, b = y * side + right, c = up * side + right,
                          d = up * side + x;
      if (choice % 16 == 0) continue;
      const bool rising = choice & 1;
      if (choice % 16 != 1)
        mesh.triangles.push_back(rising ? Triangle{a, b, c} : Triangle{a, b, d});
      if (choice % 16 != 2)
        mesh.triangles.push_back(rising ? Triangle{a, c, d} : Triangle{b, c, d});
      if (choice == 131) mesh.triangles.push_back({a, b, (a + 5) % (side * side)});
    }
  }
  return mesh;
}

inline void require_of_adaptive_mesh(bool kept, const char* what) {
  if (kept) return;
  std::fprintf(stderr, "AdaptiveMesh: broken promise: %s\n", what);
  std::abort();
}

/// What an adaptive mesh promises, through a chain of random operations on `mesh` with `log`. Ends
/// the process where it is broken, as fuzzers want it.
inline void expect_adaptive_mesh_keeps_promises(const TriangleMesh& mesh,
                                                const std::vector<Removal>& log, std::uint64_t seed,
                                                int operations) {
  auto adaptive = AdaptiveMesh::make(mesh, log);
  require_of_adaptive_mesh(adaptive.has_value(), "a legal log is taken");
  const SurfaceKind kind(mesh);
  Random random(seed, 1);
  for (int i = 0; i < operations; ++i) {
    random_operation(*adaptive, mesh, 12, random);
    const TriangleMesh now = adaptive->mesh();
    require_of_adaptive_mesh(check(now).has_value(), "the mesh is sound");
    require_of_adaptive_mesh(now.triangles.size() == adaptive->triangle_count() &&
                                 now.positions.size() == adaptive->vertex_count(),
                             "counts are counts");
    require_of_adaptive_mesh(SurfaceKind(now).comes_of(kind), "it is the same surface");
  }
  const std::size_t count = log.empty() ? 0 : random.below(log.size() + 1);
  adaptive->to_removals(count);
  PlainRemovals plain(mesh);
  for (std::size_t k = 0; k < count; ++k) plain.remove(log[k].vertex, log[k].into);
  require_of_adaptive_mesh(adaptive->mesh() == plain.mesh(), "a level is the log's beginning");
  adaptive->restore();
  require_of_adaptive_mesh(adaptive->mesh() == mesh, "all comes back, bit for bit");

  adaptive->to_removals(count);
  adaptive->remember_detail();
  for (int i = 0; i < operations; ++i) random_operation(*adaptive, mesh, 12, random);
  adaptive->restore();
  const TriangleMesh back = adaptive->mesh();
  require_of_adaptive_mesh(back.triangles == mesh.triangles, "triangles come back with detail");
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const double off = norm(Vec3d(back.positions[v]) - Vec3d(mesh.positions[v]));
    require_of_adaptive_mesh(off <= 1e-5, "vertices come back with detail to within rounding");
  }
}

/// The same with a random log, and with that of point removal.
inline void expect_adaptive_mesh_keeps_promises(const TriangleMesh& mesh, std::uint64_t seed,
                                                int operations) {
  const std::vector<Removal> by_chance = random_removals(mesh, mesh.positions.size(), seed);
  expect_adaptive_mesh_keeps_promises(mesh, by_chance, seed, operations);
  const auto by_error = removal_log(mesh);
  require_of_adaptive_mesh(by_error.has_value(), "points can be removed from any mesh");
  expect_adaptive_mesh_keeps_promises(mesh, *by_error, seed, operations);
}

}  // namespace burnish::test
