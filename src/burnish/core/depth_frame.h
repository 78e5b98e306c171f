#pragma once

#include <cstdint>
#include <vector>

#include "burnish/base/result.h"
#include "burnish/base/rigid.h"

namespace burnish {

/// A pinhole camera without distortion; x right, y down, z forward; the centre of the first pixel
/// is at (0, 0). Pixels.
struct Camera {
  std::uint32_t width = 0, height = 0;
  double fx = 0, fy = 0;  ///< focal lengths
  double cx = 0, cy = 0;  ///< principal point

  /// The point at depth z (along +z, m) seen by pixel (u, v).
  Vec3d unproject(double u, double v, double z) const {
    return {(u - cx) / fx * z, (v - cy) / fy * z, z};
  }
  /// Column and row where a point with z > 0 is seen, and its depth.
  Vec3d project(const Vec3d& p) const { return {fx * p.x / p.z + cx, fy * p.y / p.z + cy, p.z}; }

  friend bool operator==(const Camera&, const Camera&) = default;
};

/// Whether sizes and focal lengths are positive and the principal point is finite and near the
/// image.
Result<void> check(const Camera& camera);

/// Standard deviations of a depth measurement as functions of depth z (m) and of the angle theta
/// between the surface normal and the ray (rad). Coefficients of one formula, which holds the
/// models of Nguyen, Izadi and Lovell 2012 and of Fankhauser et al. 2015; sensor/presets.h has
/// their values.
///   axial(z, theta)   = c0 + c1 (z - z0) + c2 (z - z0)^2 + grazing z^power g(theta)        [m]
///   lateral(z, theta) = (pixels + pixels_grazing theta / (pi/2 - theta)) z / fx + metres   [m]
///   g(theta)          = theta^2 / (pi/2 - theta)^2 beyond grazing_from, else 0
struct DepthNoise {
  double z0 = 0, c0 = 0, c1 = 0, c2 = 0;
  double grazing = 0, power = 0, grazing_from = 0;
  double pixels = 0, pixels_grazing = 0, metres = 0;
  double min_depth = 0, max_depth = 0;  ///< outside there is no measurement; max 0: no limit

  /// theta is taken at most 85 degrees, where the published formulas end.
  double axial(double z, double theta) const;
  double lateral(double z, double theta, double fx) const;

  friend bool operator==(const DepthNoise&, const DepthNoise&) = default;
};

/// One image of a depth camera, or what was made of one or several from one place.
struct DepthFrame {
  Camera camera;
  std::vector<float> depth;  ///< width * height, row by row, along +z, m; 0 = none
  RigidTransform T_world_camera;
  DepthNoise noise;  ///< of a single image as the camera gives it
  double time = 0;   ///< s

  // What is known of each pixel besides; each is as long as depth, or empty: 1 for all.
  /// The axial deviation of its measurement, in shares of noise.axial: less for a mean of several.
  std::vector<float> noise_share{};
  /// The same of its depth as it is now: smoothing makes it less. Empty: noise_share's.
  std::vector<float> sigma_share{};
  std::vector<std::uint32_t> observations{};  ///< how many measurements it is the mean of

  double noise_share_of(std::size_t pixel) const {
    return noise_share.empty() ? 1 : double{noise_share[pixel]};
  }
  double sigma_share_of(std::size_t pixel) const {
    return sigma_share.empty() ? noise_share_of(pixel) : double{sigma_share[pixel]};
  }

  friend bool operator==(const DepthFrame&, const DepthFrame&) = default;
};

/// Whether the camera is sound, depth has a value for every pixel, as has what else is there of
/// pixels, none negative or not finite, and the pose is a rotation and a translation. Errors:
/// bad_geometry.
Result<void> check(const DepthFrame& frame);

}  // namespace burnish
