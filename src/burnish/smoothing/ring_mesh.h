#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "burnish/base/parallel.h"
#include "burnish/core/adjacency.h"
#include "burnish/smoothing/ring_sweep.h"
#include "burnish/smoothing/smoothing.h"
#include "burnish/smoothing/smoothing_weights.h"

// What the smoothings that work on one-rings begin with, repeat and end with. Not part of the
// library's interface.
namespace burnish {

/// Whom each vertex follows.
struct MovableRings {
  Adjacency rings;             ///< neighbours of each vertex; none where it stays or is pinned
  std::vector<float> follows;  ///< what smoothing_weights.h says; empty: 1 for all

  /// The share of every move that vertex v makes.
  double follow(std::size_t v) const { return follows.empty() ? 1 : double{follows[v]}; }
};

/// A mesh as these smoothings work on it: in double from the first pass to the last.
struct RingMesh : MovableRings {
  std::vector<Vec3d> positions;
};

/// The same for many passes over the rings, in the numbering of the sweep.
struct SweptMesh {
  RingSweep sweep;
  std::vector<float> follows;
  LargeVector<Vec3d> positions;

  double follow(std::size_t v) const { return follows.empty() ? 1 : double{follows[v]}; }
};

/// The neighbours that the boundary rule gives each vertex; none where it is to stay.
Adjacency smoothing_rings(const TriangleMesh& mesh, BoundaryRule boundary);

/// Errors: bad_geometry.
Result<RingMesh> ring_mesh(const TriangleMesh& mesh, BoundaryRule boundary);

/// Errors: bad_geometry, cancelled.
Result<SweptMesh> swept_mesh(const TriangleMesh& mesh, BoundaryRule boundary, int passes,
                             const Context& context, const SweepLayout& layout = {});

/// The context of one of several passes over the rings: its share of the bar, and one thread where
/// all of them together are too little work for more.
Context part_of_pass(const Context& context, int pass, int passes, const Adjacency& rings);

/// The umbrella operator (Taubin 1995, with equal weights) at v: the mean of `values` over its ring
/// less values[v]; 0 where there is no ring.
inline Vec3d ring_step(const Vec3d* values, std::size_t v, std::span<const std::uint32_t> ring) {
  Vec3d sum;
  for (const std::uint32_t w : ring) sum += values[w];
  return ring.empty() ? Vec3d{} : sum / static_cast<double>(ring.size()) - values[v];
}

/// The end of a smoothing: puts `positions` into the mesh, and normals where there were some.
/// Errors: invalid_argument where a position is beyond the range of float, which settings that
/// amplify can bring about; the mesh is then as it was.
Result<SmoothingReport> commit_positions(TriangleMesh& mesh, const std::vector<Vec3d>& positions,
                                         int iterations, const Context& context);
/// The same for positions in the numbering of a sweep.
Result<SmoothingReport> commit_positions(TriangleMesh& mesh, const RingSweep& sweep,
                                         const LargeVector<Vec3d>& positions, int iterations,
                                         const Context& context);

}  // namespace burnish
