#pragma once

#include <cstdint>
#include <vector>

#include "burnish/core/depth_frame.h"

namespace burnish {

/// What a Kinect v1 says of its geometry (libfreenect's freenect_zero_plane_info), in cm; the
/// defaults are those of libfreenect for a device that is not asked.
struct ZeroPlane {
  double emitter_distance = 7.5;         ///< from the camera to the projector
  double reference_distance = 120;       ///< of the plane whose disparity is the constant shift
  double reference_pixel_size = 0.1042;  ///< of a pixel of 1280 x 1024 on that plane
  double constant_shift = 200;           ///< such pixels
};

/// Depth (m) of a raw 11-bit disparity, by libfreenect's registration.c (freenect_raw_to_mm):
///   m = ((raw - 4 constant_shift) / 4 - 0.375) reference_pixel_size
///   z = (m reference_distance / (emitter_distance - m) + reference_distance) / 100
/// 0, no depth, for 2047 and for what would be behind the camera or farther than 10 m.
double depth_of_disparity(std::uint16_t raw, const ZeroPlane& plane);

/// The camera of its 640 x 480 depth images, as libfreenect's freenect_camera_to_world has it:
/// fx = fy = reference_distance / (2 reference_pixel_size), c = (320, 240).
Camera camera_of(const ZeroPlane& plane);

}  // namespace burnish
