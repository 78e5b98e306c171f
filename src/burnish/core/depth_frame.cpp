#include "burnish/core/depth_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace burnish {
namespace {

constexpr double kSteepest = 85 * std::numbers::pi / 180;

/// theta / (pi/2 - theta), which grows without bound towards grazing incidence.
double grazing_ratio(double theta) {
  const double angle = std::clamp(theta, 0.0, kSteepest);
  return angle / (std::numbers::pi / 2 - angle);
}

}  // namespace

Result<void> check(const Camera& camera) {
  const bool sized = camera.width > 0 && camera.height > 0;
  const bool focused =
      std::isfinite(camera.fx) && std::isfinite(camera.fy) && camera.fx > 0 && camera.fy > 0;
  const bool centred = std::abs(camera.cx - camera.width / 2.0) <= camera.width &&
                       std::abs(camera.cy - camera.height / 2.0) <= camera.height;
  if (sized && focused && centred) return {};
  return Error{
      ErrorCode::invalid_argument,
      fmt::format("camera {}x{} fx={} fy={} cx={} cy={} cannot be: sizes and focal lengths must "
                  "be positive, the principal point near the image",
                  camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy),
      {}};
}

double DepthNoise::axial(double z, double theta) const {
  const double d = z - z0;
  const double base = c0 + c1 * d + c2 * d * d;
  if (grazing == 0 || theta <= grazing_from) return base;
  const double ratio = grazing_ratio(theta);
  return base + grazing * std::pow(z, power) * ratio * ratio;
}

double DepthNoise::lateral(double z, double theta, double fx) const {
  return (pixels + pixels_grazing * grazing_ratio(theta)) * z / fx + metres;
}

Result<void> check(const DepthFrame& frame) {
  if (auto camera = check(frame.camera); !camera) return camera;
  const std::size_t pixels = std::size_t{frame.camera.width} * frame.camera.height;
  if (frame.depth.size() != pixels) {
    return Error{ErrorCode::bad_geometry,
                 fmt::format("{} depths for {} x {} pixels", frame.depth.size(), frame.camera.width,
                             frame.camera.height),
                 {}};
  }
  for (std::size_t i = 0; i < pixels; ++i) {
    if (!(frame.depth[i] >= 0 && std::isfinite(frame.depth[i]))) {
      return Error{
          ErrorCode::bad_geometry, fmt::format("depth of pixel {} is {}", i, frame.depth[i]), {}};
    }
  }
  if (!(rotation_defect(frame.T_world_camera) < 1e-3) ||
      !is_finite(frame.T_world_camera.translation)) {
    return Error{ErrorCode::bad_geometry, "the pose is not a rotation and a translation", {}};
  }
  return {};
}

}  // namespace burnish
