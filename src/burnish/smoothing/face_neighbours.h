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

/// No ball takes up more than this: some meshes have no end of slivers in one place.
inline constexpr std::size_t kMostInABall = 512;

/// Per point itself and all that are nearer to it than `radius`, as far as one comes to them from
/// neighbour to neighbour without leaving this ball: the other side of a thin wall is not among
/// them. Points may be the centroids of faces or vertices. Where there are more than kMostInABall,
/// the first to be met. O(neighbours of what is in the ball). False where cancelled.
[[nodiscard]] bool connected_within(const Context& context, float radius,
                                    const std::vector<Quad>& points, const Adjacency& neighbours,
                                    Adjacency& balls);

}  // namespace burnish
