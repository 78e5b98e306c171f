#pragma once

#include <cstdint>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/result.h"
#include "burnish/core/depth_frame.h"
#include "burnish/core/triangle_mesh.h"
#include "burnish/sensor/disturbance.h"
#include "burnish/sensor/presets.h"
#include "burnish/spatial/ray_caster.h"

namespace burnish {

/// A depth camera that looks at a mesh.
///
/// Exact depth: a pixel's depth is the z of the first point that the ray through its centre meets,
/// from either side of the surface, rounded to float; 0 where there is none or out of range.
///
/// What noise does to it, sensor/disturbance.h says. The same bytes for any number of threads. One
/// ray a pixel, two where a projector stands apart.
class VirtualCamera {
 public:
  /// Errors: bad_geometry where check(mesh) fails or there is no triangle, invalid_argument where
  /// the camera is not sound, cancelled. World coordinates are mesh.frame.origin + positions.
  static Result<VirtualCamera> create(const TriangleMesh& mesh, const Sensor& sensor,
                                      const Context& context = {});

  /// Takes a picture. Errors: invalid_argument where noise is negative or the pose is no rotation,
  /// cancelled.
  Result<DepthFrame> capture(const RigidTransform& T_world_camera, const CaptureParams& params = {},
                             const Context& context = {}) const;

 private:
  VirtualCamera(const TriangleMesh& mesh, const Sensor& sensor, const Context& context);

  Sight look(const RigidTransform& pose, std::uint32_t column, std::uint32_t row) const;

  Sensor sensor_;
  Vec3d origin_;                ///< of the mesh's frame
  std::vector<Vec3f> normals_;  ///< per triangle, unit length
  RayCaster caster_;
};

}  // namespace burnish
