#include "burnish/sensor/disturbance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "burnish/base/parallel.h"
#include "burnish/core/noise_correlation.h"
#include "burnish/sensor/image_noise.h"

namespace burnish {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
/// Patches below this are lost at depth edges: a quarter of the pixels.
constexpr float kLostAtEdges = -0.6745f;
constexpr double kLastIncidence = 80 * kDegree;
constexpr double kIncidenceSpread = 4 * kDegree;
constexpr double kSteepestSlope = 5.67;  ///< tan 80 degrees; where depth rises faster is an edge
constexpr int kLateralReach = 2;         ///< px, how near an edge outlines fray
constexpr std::size_t kPixelsAtOnce = 4096;

/// The pixels of a sensor, what they see and what they measure.
class Disturber {
 public:
  Disturber(const Sensor& sensor, const std::vector<Sight>& sights, const CaptureParams& params,
            const ImageNoise& noise)
      : sensor_(sensor),
        sights_(sights),
        params_(params),
        noise_(noise),
        width_(static_cast<int>(sensor.camera.width)),
        height_(static_cast<int>(sensor.camera.height)) {}

  double measure(std::size_t pixel) const {
    const Sight sight = shifted(pixel);
    if (sight.depth == 0 || lost(sight, pixel)) return 0;
    return with_steps(with_axial_noise(sight, pixel));
  }

 private:
  const Sight& at(int column, int row) const {
    return sights_[static_cast<std::size_t>(std::clamp(row, 0, height_ - 1)) * width_ +
                   std::clamp(column, 0, width_ - 1)];
  }

  double sigma(const Sight& sight) const {
    return params_.noise * sensor_.noise.axial(sight.depth, sight.incidence);
  }

  /// Whether depth changes more between two pixels than a measurable surface and noise explain.
  bool jumps(const Sight& a, const Sight& b, double pixels) const {
    if ((a.depth == 0) != (b.depth == 0)) return true;
    const Sight& near = a.depth < b.depth ? a : b;
    const double rise = near.depth / sensor_.camera.fx * kSteepestSlope * pixels;
    return std::abs(a.depth - b.depth) > rise + 3 * sensor_.noise.axial(near.depth, 0);
  }

  /// The nearest surface within `reach` pixels of one that sees an edge there; none in the midst of
  /// a surface or of nothing.
  const Sight* surface_at_edge(std::size_t pixel, int reach) const {
    const int column = static_cast<int>(pixel) % width_, row = static_cast<int>(pixel) / width_;
    const Sight& own = sights_[pixel];
    const Sight* nearest = own.depth > 0 ? &own : nullptr;
    bool edge = false;
    for (int dy = -reach; dy <= reach; ++dy) {
      for (int dx = -reach; dx <= reach; ++dx) {
        const Sight& other = at(column + dx, row + dy);
        edge = edge || jumps(own, other, std::max(std::abs(dx), std::abs(dy)));
        if (other.depth > 0 && (!nearest || other.depth < nearest->depth)) nearest = &other;
      }
    }
    return edge ? nearest : nullptr;
  }

  Sight shifted(std::size_t pixel) const {
    const Sight& own = sights_[pixel];
    const Sight* surface = surface_at_edge(pixel, kLateralReach);
    if (!surface) return own;
    const double fx = sensor_.camera.fx;
    const double sigma_px = params_.noise * fx / surface->depth *
                            sensor_.noise.lateral(surface->depth, surface->incidence, fx);
    const int dx = static_cast<int>(std::lround(sigma_px * noise_.shift_x[pixel]));
    const int dy = static_cast<int>(std::lround(sigma_px * noise_.shift_y[pixel]));
    const Sight& other =
        at(static_cast<int>(pixel) % width_ + dx, static_cast<int>(pixel) / width_ + dy);
    return jumps(own, other, std::max(std::abs(dx), std::abs(dy))) ? other : own;
  }

  bool lost(const Sight& sight, std::size_t pixel) const {
    if (!sight.lit) return true;
    const double limit = kLastIncidence + kIncidenceSpread * noise_.patches[pixel];
    if (sight.incidence > limit) return true;
    return noise_.patches[pixel] < kLostAtEdges && surface_at_edge(pixel, 1);
  }

  /// The distance at depth z between two depths that the sensor can tell.
  double step(double z) const { return params_.noise * sensor_.disparity_step * z * z; }

  double with_axial_noise(const Sight& sight, std::size_t pixel) const {
    const double s = sigma(sight), quantum = step(sight.depth);
    const double white = std::sqrt(std::max(0.0, kWhiteShare * s * s - quantum * quantum / 12));
    return sight.depth + s * noise_.smooth[pixel] + white * noise_.white[pixel];
  }

  double with_steps(double depth) const {
    const double unit = params_.noise * sensor_.disparity_step;  // 1/m
    if (unit == 0 || depth <= 0) return depth;
    const double disparity = std::round(1 / (depth * unit));
    return disparity > 0 ? 1 / (disparity * unit) : 0;
  }

  const Sensor& sensor_;
  const std::vector<Sight>& sights_;
  const CaptureParams& params_;
  const ImageNoise& noise_;
  int width_, height_;
};

float in_range(const DepthNoise& limits, double depth) {
  const bool far = limits.max_depth > 0 && depth > limits.max_depth;
  return depth > 0 && depth >= limits.min_depth && !far ? static_cast<float>(depth) : 0.f;
}

}  // namespace

std::optional<std::vector<float>> disturb(const Sensor& sensor, const std::vector<Sight>& sights,
                                          const CaptureParams& params, const Context& context) {
  std::vector<float> depth(sights.size());
  if (params.noise == 0) {
    for (std::size_t i = 0; i < depth.size(); ++i)
      depth[i] = in_range(sensor.noise, sights[i].depth);
    context.progress(1);
    return depth;
  }
  const auto noise = draw_image_noise(sensor.camera.width, sensor.camera.height, params.seed,
                                      params.view, context);
  if (!noise) return std::nullopt;
  const Disturber disturber(sensor, sights, params, *noise);
  const bool complete = parallel_for(
      context, depth.size(),
      [&](IndexRange pixels) {
        for (std::size_t i = pixels.begin; i < pixels.end; ++i) {
          depth[i] = in_range(sensor.noise, disturber.measure(i));
        }
      },
      kPixelsAtOnce);
  if (!complete) return std::nullopt;
  return depth;
}

}  // namespace burnish
