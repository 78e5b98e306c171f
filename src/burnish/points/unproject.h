#pragma once

#include "burnish/base/context.h"
#include "burnish/base/schema.h"
#include "burnish/core/depth_frame.h"
#include "burnish/core/point_cloud.h"

namespace burnish {

struct UnprojectParams {
  double min_depth = 0;  ///< m, along the camera's z; 0: the sensor's own limit
  double max_depth = 0;  ///< m; 0: the sensor's own limit
  int window = 0;        ///< radius of the normals' window, pixels; 0: sized by the noise
  bool normals = true;   ///< false: neither normals nor noise, in a tenth of the time

  static const Schema<UnprojectParams>& schema();
};

/// The points that a depth camera saw, as an organized cloud in world coordinates: pixel (u, v) of
/// depth z is T_world_camera ((u - cx) z / fx, (v - cy) z / fy, z), computed in double, kept in
/// float around frame_near(the camera). Pixels without depth or out of range are NaN. Attributes of
/// every pixel:
///   normals       as estimate_normals gives them, towards the camera; 0 where unknown or missing
///   sigma, noise  by the sensor's noise and the frame's shares of it, see sensor_noise.h; 0 where
///                 missing
///   observations  the frame's, 1 where it has none, and 0 where missing
///   origin        seen
/// Without `normals` these and noise are left out, and sigma is that of surfaces that face the
/// camera: its axial deviation alone. O(#pixels). Errors: invalid_argument, bad_geometry,
/// cancelled.
Result<PointCloud> unproject(const DepthFrame& frame, const UnprojectParams& params = {},
                             const Context& context = {});

/// The same without normals, whatever params say, into a cloud that is there: for a camera that
/// runs. Nothing is allocated where `cloud` has held a frame of as many pixels before. Attributes
/// that `cloud` has besides those named stay as they are. Errors: as above; `cloud` is then of no
/// meaning.
Result<void> unproject_into(const DepthFrame& frame, const UnprojectParams& params,
                            const Context& context, PointCloud& cloud);

}  // namespace burnish
