#pragma once

#include "burnish/base/context.h"
#include "burnish/core/adjacency.h"
#include "burnish/core/triangle_mesh.h"
#include "burnish/smoothing/face_geometry.h"

// Which faces a face is filtered with. All rows rise. All are symmetric. Not part of the library's
// interface.
namespace burnish {

/// Where more faces than this meet in one vertex (on one edge) they are not neighbours for that:
/// lists would grow with the square of their number. At such a vertex the faces next to each other
/// across an edge remain neighbours.
inline constexpr std::size_t kMostFacesOfACorner = 64;

/// Per face the others that share an edge with it. O(#T). False where cancelled.
[[nodiscard]] bool edge_neighbours(const Context& context, const TriangleMesh& mesh,
                                   const Adjacency& faces_of_vertices, Adjacency& neighbours);

/// Per face itself and all that share a vertex with it. O(#T). False where cancelled.
[[nodiscard]] bool vertex_neighbours(const Context& context, const TriangleMesh& mesh,
                                     const Adjacency& faces_of_vertices,
                                     const Adjacency& edge_neighbours, Adjacency& neighbours);

/// Per face itself and all whose centroids are nearer to its own than `radius`, as far as one comes
/// to them from vertex-neighbour to vertex-neighbour without leaving this ball: the other side of a
/// thin wall is not among them. O(#T * faces in the ball). False where cancelled.
[[nodiscard]] bool neighbours_within(const Context& context, float radius,
                                     const std::vector<Quad>& centroids,
                                     const Adjacency& vertex_neighbours, Adjacency& neighbours);

}  // namespace burnish
