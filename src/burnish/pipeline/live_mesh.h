#pragma once

#include <vector>

#include "burnish/base/context.h"
#include "burnish/core/depth_frame.h"
#include "burnish/points/unproject.h"
#include "burnish/smoothing/grid_passes.h"
#include "burnish/triangulation/organized.h"

namespace burnish {

struct LiveMeshParams {
  UnprojectParams unproject{.normals = false};
  OrganizedParams triangulate{};
  NearestFarthestParams smooth{.iterations = 3};  ///< boundary = fixed, order = jacobi
  bool normals = false;                           ///< of the vertices of the result
};

/// The mesh of one depth frame after another, smoothed by Eq. 1, at the rate of the camera.
///
/// What comes is, to the bit, the positions and triangles of
///     smooth_nearest_farthest(triangulate_organized(unproject(frame)))
/// with unproject's normals = false and without the mesh's attributes, but for normals where they
/// are asked for. After the first frame of a size, frames of that size allocate nothing, however
/// many of their pixels have a depth, where the context has one thread.
class LiveMesh {
 public:
  explicit LiveMesh(const LiveMeshParams& params = {}) : params_(params) {}

  /// Makes the mesh of `frame`. Errors: those of the three operations; `mesh()` is then of no
  /// meaning.
  Result<void> update(const DepthFrame& frame, const Context& context = {});

  /// Of the last frame.
  const TriangleMesh& mesh() const { return mesh_; }

 private:
  LiveMeshParams params_;
  PointCloud cloud_;
  OrganizedTriangulator triangulator_;
  GridRings rings_;
  GridPasses passes_;
  std::vector<Vec3d> normal_sums_;
  TriangleMesh mesh_;
};

}  // namespace burnish
