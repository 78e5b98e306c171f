#pragma once

#include <span>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/core/adjacency.h"
#include "burnish/core/triangle_mesh.h"
#include "burnish/smoothing/quad.h"

// What filters of face normals know of the faces. Not part of the library's interface.
namespace burnish {

/// Of every face a unit normal, and beside it (w) the face's area; both are 0 where it has none.
using FaceNormals = std::vector<Quad>;

struct FaceGeometry {
  FaceNormals normals;
  std::vector<Quad> centroids;  ///< w is 0
};

/// The positions of a mesh measured from their mean in a length of its own. Floats then hold areas
/// and distances of meshes of any size, and what follows is the same for all sizes, to the last bit
/// where they differ by a power of two.
struct FaceSurface {
  std::vector<Vec3d> positions;
  double unit = 1;  ///< m
};

/// `unit` > 0.
FaceSurface face_surface(const TriangleMesh& mesh, double unit);

/// The mean distance between the centroids of two faces that share an edge; the mean edge length
/// where there are no such faces, and 1 where that is 0. m.
double mean_centroid_distance(const TriangleMesh& mesh, const Adjacency& edge_neighbours);

/// Computed in double; `faces` is made as long as there are triangles. O(#T). False where
/// cancelled.
[[nodiscard]] bool measure_faces(const Context& context, std::span<const Triangle> triangles,
                                 std::span<const Vec3d> positions, FaceGeometry& faces);

}  // namespace burnish
