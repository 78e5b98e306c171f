#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "burnish/base/parallel.h"
#include "burnish/core/adjacency.h"
#include "burnish/smoothing/smoothing.h"
#include "burnish/smoothing/smoothing_weights.h"

// What the smoothings that work on one-rings begin with, repeat and end with. Not part of the
// library's interface.
namespace burnish {

/// A mesh as these smoothings work on it: in double from the first pass to the last.
struct RingMesh {
  Adjacency rings;             ///< neighbours of each vertex; none where it stays or is pinned
  std::vector<float> follows;  ///< what smoothing_weights.h says; empty: 1 for all
  std::vector<Vec3d> positions;

  /// The share of every move that vertex v makes.
  double follow(std::size_t v) const { return follows.empty() ? 1 : double{follows[v]}; }
};

/// The neighbours that the boundary rule gives each vertex; none where it is to stay.
Adjacency smoothing_rings(const TriangleMesh& mesh, BoundaryRule boundary);

/// Errors: bad_geometry.
Result<RingMesh> ring_mesh(const TriangleMesh& mesh, BoundaryRule boundary);

std::vector<Vec3d> in_double(const std::vector<Vec3f>& positions);
std::vector<Vec3f> in_float(const std::vector<Vec3d>& positions);
std::size_t longest_row(const Adjacency& rows);

/// The context of one of several passes over the rings: its share of the bar, and one thread where
/// all of them together are too little work for more.
Context part_of_pass(const Context& context, int pass, int passes, const Adjacency& rings);

/// The umbrella operator (Taubin 1995, with equal weights): steps[v] is the mean of `values` over
/// the ring of v less values[v]; 0 for vertices without a ring. Returns false where the context was
/// cancelled.
[[nodiscard]] bool ring_steps(const Context& context, const Adjacency& rings,
                              const std::vector<Vec3d>& values, std::vector<Vec3d>& steps);

/// The end of a smoothing: puts `positions` into the mesh, and normals where there were some.
/// Errors: invalid_argument where a position is beyond the range of float, which settings that
/// amplify can bring about; the mesh is then as it was.
Result<SmoothingReport> commit_positions(TriangleMesh& mesh, const std::vector<Vec3d>& positions,
                                         int iterations, const Context& context);

}  // namespace burnish
