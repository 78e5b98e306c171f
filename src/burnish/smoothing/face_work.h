#pragma once

#include <span>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/result.h"
#include "burnish/core/adjacency.h"
#include "burnish/core/triangle_mesh.h"
#include "burnish/smoothing/face_geometry.h"
#include "burnish/smoothing/smoothing.h"

// The beginning and the end of every smoothing by face normals. Not part of the library's
// interface.
namespace burnish {

/// What is found of a mesh before its faces are filtered.
struct FaceWork {
  std::vector<float> follows;                                       ///< smoothing_weights.h
  Adjacency faces_of_vertices, edge_neighbours, vertex_neighbours;  ///< face_neighbours.h
  FaceSurface surface;
};

/// The context with one thread where a pass over so many faces is done before others are awake.
Context for_passes_over(std::size_t faces, const Context& context);

/// Errors: bad_geometry, cancelled. O(#T).
Result<FaceWork> begin_face_work(const TriangleMesh& mesh, const Context& context);

/// Gives `mesh` the positions, which are in lengths of `surface`. Normals that are there are
/// computed anew. Sigma stays: a filtered normal averages many measurements, so that errors become
/// smaller, but how much depends on what the filter took for an edge; the old value is on the safe
/// side. Vertices that did not move keep every bit.
SmoothingReport finish_face_work(TriangleMesh& mesh, const FaceSurface& surface,
                                 std::span<const Vec3d> positions, int iterations);

}  // namespace burnish
