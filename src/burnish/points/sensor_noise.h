#pragma once

#include "burnish/core/attributes.h"
#include "burnish/core/depth_frame.h"

namespace burnish {

/// How far a depth camera's measurement may be off.
struct MeasuredNoise {
  float sigma = 0;   ///< across the surface, m
  PointNoise noise;  ///< along the ray and across it
};

/// What shares of the sensor's axial deviation are left: DepthFrame::noise_share and sigma_share.
struct AxialShares {
  double noise = 1, sigma = 1;
};

/// The sensor errs by axial(z, theta) along the ray and by lateral(z, theta) across it, theta being
/// the angle between ray and normal, 0 where `normal` is. An error within the surface leaves the
/// surface where it is, so that sigma is the error's part along the normal:
///   sigma^2 = axial^2 cos^2(theta) + lateral^2 sin^2(theta).
/// `ray`: from the camera to the point, m; z: the point's depth, m; fx: the focal length, pixels.
/// `left`: of the axial error; the lateral one stays, as no mean or filter of depths changes where
/// a pixel looks.
MeasuredNoise measured_noise(const DepthNoise& sensor, double fx, double z, const Vec3d& ray,
                             const Vec3f& normal, const AxialShares& left = {});

}  // namespace burnish
