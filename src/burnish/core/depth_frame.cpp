#include "burnish/core/depth_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

namespace burnish {
namespace {

constexpr double kSteepest = 85 * std::numbers::pi / 180;

/// theta / (pi/2 - theta), which grows without bound towards grazing incidence.
double grazing_ratio(double theta) {
  const double angle = std::clamp(theta, 0.0, kSteepest);
  return angle / (std::numbers::pi / 2 - angle);
}

/// Whether something that is known of every pixel is there of as many as `camera` has.
Result<void> check_count(std::string_view what, std::size_t count, const Camera& camera) {
  if (count == std::size_t{camera.width} * camera.height) return {};
  return Error{ErrorCode::bad_geometry,
               fmt::format("{} {} for {} x {} pixels", count, what, camera.width, camera.height),
               {}};
}

/// The same for numbers, none of which may be negative or not finite.
Result<void> check_values(std::string_view what, const std::vector<float>& values,
                          const Camera& camera) {
  if (auto enough = check_count(std::string(what) + "s", values.size(), camera); !enough) {
    return enough;
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(values[i] >= 0 && std::isfinite(values[i]))) {
      return Error{
          ErrorCode::bad_geometry, fmt::format("{} of pixel {} is {}", what, i, values[i]), {}};
    }
  }
  return {};
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
  if (auto camera = check(frame.camera); !camera) {
    return Error{ErrorCode::bad_geometry, camera.error().message, {}};
  }
  if (auto sound = check_values("depth", frame.depth, frame.camera); !sound) return sound;
  for (const auto& [what, shares] : {std::pair("noise share", &frame.noise_share),
                                     std::pair("sigma share", &frame.sigma_share)}) {
    if (shares->empty()) continue;
    if (auto sound = check_values(what, *shares, frame.camera); !sound) return sound;
  }
  if (!frame.observations.empty()) {
    auto enough = check_count("observations", frame.observations.size(), frame.camera);
    if (!enough) return enough;
  }
  if (!(rotation_defect(frame.T_world_camera) < 1e-3) ||
      !is_finite(frame.T_world_camera.translation)) {
    return Error{ErrorCode::bad_geometry, "the pose is not a rotation and a translation", {}};
  }
  return {};
}

}  // namespace burnish
