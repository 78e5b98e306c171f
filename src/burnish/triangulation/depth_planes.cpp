#include "burnish/triangulation/depth_planes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "burnish/base/parallel.h"
#include "burnish/core/noise_correlation.h"

namespace burnish {
namespace {

constexpr std::size_t kRowsAtOnce = 8;
constexpr double kSteepest = 3.73;       // tan 75 degrees
constexpr double kLeastCosine = 0.17;    // 80 degrees: what is seen flatter tells nothing
constexpr double kEdgeTrust = 1. / 16;   // of pixels at the edges of things, as merge_cells has it
constexpr double kLeastSigma = 1. / 64;  // in units: weights stay finite where there is no noise
constexpr std::size_t kCosineSteps = 256;

/// The share of a mean's variance that pixels `u`, `v` apart have in common.
double correlation(double u, double v) {
  const double squared = u * u + v * v;
  const double white = squared == 0 ? kWhiteShare : 0;
  return white + kFineShare * std::exp(-squared / (4 * kFineBlur * kFineBlur)) +
         kCoarseShare * std::exp(-squared / (4 * kCoarseBlur * kCoarseBlur));
}

/// variance_of_mean(2^level).
double kept_at(std::size_t level) {
  static const std::array<double, DepthPlanes::kLevels + 1> kept{
      variance_of_mean(1), variance_of_mean(2), variance_of_mean(4), variance_of_mean(8)};
  return kept[level];
}

}  // namespace

double variance_of_mean(int side) {
  double sum = 0;
  for (int u = 1 - side; u < side; ++u) {
    for (int v = 1 - side; v < side; ++v) {
      sum += (side - std::abs(u)) * (side - std::abs(v)) * correlation(u, v);
    }
  }
  return sum / std::pow(side, 4);
}

int DepthPlanes::level_for(double footprint) {
  int level = 1;
  while (level < kLevels && (2 << level) <= footprint) ++level;
  return level;
}

bool DepthPlanes::build(const DepthFrame& frame, const Measure& measure, const Context& context) {
  camera_ = frame.camera;
  noise_ = frame.noise;
  measure_ = measure;
  grazing_.resize(kCosineSteps + 1);
  for (std::size_t i = 0; i <= kCosineSteps; ++i) {
    const double theta = std::acos(static_cast<double>(i) / kCosineSteps);
    grazing_[i].axial = noise_.axial(1, theta) - noise_.axial(1, 0);
    grazing_[i].lateral =
        noise_.lateral(1, theta, camera_.fx) - noise_.lateral(0, theta, camera_.fx);
  }
  const double farthest =
      noise_.max_depth > 0 ? noise_.max_depth : std::numeric_limits<double>::infinity();
  Level& pixels = levels_[0];
  pixels.width = camera_.width, pixels.height = camera_.height;
  pixels.share = frame.sigma_share.empty() ? frame.noise_share : frame.sigma_share;
  pixels.inverse.resize(frame.depth.size());
  pixels.planes.resize(frame.depth.size());
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    const float z = frame.depth[i];
    pixels.inverse[i] = z > 0 && z >= noise_.min_depth && z <= farthest ? 1 / z : 0;
  }
  const auto for_rows = [&](const Context& part, std::size_t level, auto work) {
    return parallel_for(
        part, levels_[level].height,
        [&](IndexRange rows) {
          for (std::size_t row = rows.begin; row < rows.end; ++row) (this->*work)(level, row);
        },
        kRowsAtOnce);
  };
  for (std::size_t level = 1; level <= kLevels; ++level) {
    const Level& finer = levels_[level - 1];
    Level& here = levels_[level];
    here.width = (finer.width + 1) / 2, here.height = (finer.height + 1) / 2;
    here.inverse.resize(here.width * here.height);
    here.share.resize(finer.share.empty() ? 0 : here.inverse.size());
    here.planes.resize(here.inverse.size());
    const double done = static_cast<double>(level - 1) / kLevels;
    if (!for_rows(context.part(done / 2, (done + 1. / kLevels) / 2), level, &DepthPlanes::average))
      return false;
  }
  for (std::size_t done = 0; done <= kLevels; ++done) {
    const double share = 1.0 / (kLevels + 1), begin = static_cast<double>(done) * share;
    const Context part = context.part((1 + begin) / 2, (1 + begin + share) / 2);
    if (!for_rows(part, kLevels - done, &DepthPlanes::fit)) return false;
  }
  return true;
}

/// By how much 1 / z may differ between places of one surface that are `pixels` apart.
double DepthPlanes::jump(double inverse, double share, double pixels) const {
  const double noise = 3 * share * noise_.axial(1 / inverse, 0) * inverse;
  return inverse * (noise + kSteepest * pixels / std::min(camera_.fx, camera_.fy));
}

/// A row of means of what the finer level holds.
void DepthPlanes::average(std::size_t level, std::size_t row) {
  const Level& finer = levels_[level - 1];
  Level& here = levels_[level];
  const double apart = std::sqrt(0.5) * (1 << level);
  for (std::size_t x = 0; x < here.width; ++x) {
    const std::size_t i = row * here.width + x, first = 2 * row * finer.width + 2 * x;
    here.inverse[i] = 0;
    if (2 * x + 1 >= finer.width || 2 * row + 1 >= finer.height) continue;
    const std::array<std::size_t, 4> quarters{first, first + 1, first + finer.width,
                                              first + finer.width + 1};
    const float a = finer.inverse[quarters[0]], b = finer.inverse[quarters[1]],
                c = finer.inverse[quarters[2]], d = finer.inverse[quarters[3]];
    const float least = std::min(std::min(a, b), std::min(c, d));
    const float most = std::max(std::max(a, b), std::max(c, d));
    if (!(least > 0)) continue;
    double share = 1;
    if (!finer.share.empty()) {
      share = 0;
      for (const std::size_t quarter : quarters) share += finer.share[quarter] / 4.0;
      here.share[i] = static_cast<float>(share);
    }
    if (most - least > jump(least, share, apart)) continue;
    here.inverse[i] = ((a + b) + (c + d)) / 4;
  }
}

/// The slope of 1 / z over the image, per pixel.
DepthPlanes::Slope DepthPlanes::slope(std::size_t level, std::size_t x, std::size_t y) const {
  const Level& here = levels_[level];
  const std::size_t i = y * here.width + x;
  const double inverse = here.inverse[i], side = 1 << level;
  if (!(inverse > 0)) return {};
  const double limit = jump(inverse, here.share.empty() ? 1 : double{here.share[i]}, side);
  // Along one axis, from what lies on either side; false where nothing does.
  const auto along = [&](bool before, bool after, std::size_t step, double& slope) {
    double rise = 0, steps = 0;
    if (after && here.inverse[i + step] > 0) {
      const double up = here.inverse[i + step] - inverse;
      if (std::abs(up) <= limit) rise += up, steps += 1;
    }
    if (before && here.inverse[i - step] > 0) {
      const double up = inverse - here.inverse[i - step];
      if (std::abs(up) <= limit) rise += up, steps += 1;
    }
    if (steps > 0) slope = rise / (steps * side);
    return steps > 0;
  };
  Slope slope;
  slope.known = along(x > 0, x + 1 < here.width, 1, slope.u) &&
                along(y > 0, y + 1 < here.height, here.width, slope.v);
  return slope;
}

/// A row of planes. Patches of 2 x 2 pixels are too small for a slope of their own.
void DepthPlanes::fit(std::size_t level, std::size_t row) {
  Level& here = levels_[level];
  const double side = 1 << level, kept = kept_at(level);
  Slope found;
  for (std::size_t x = 0; x < here.width; ++x) {
    const std::size_t i = row * here.width + x;
    here.planes[i].weight = 0;
    if (level == 0) {
      const Level& pairs = levels_[1];
      if (!(pairs.planes[row / 2 * pairs.width + x / 2].weight > 0)) {
        here.planes[i] =
            pixel_plane(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(row));
      }
      continue;
    }
    if (level > 1) {
      found = slope(level, x, row);
    } else if (x % 2 == 0) {
      found = slope(2, x / 2, row / 2);
    }
    if (!(here.inverse[i] > 0) || !found.known) continue;
    const double u = (static_cast<double>(x) + 0.5) * side - 0.5;
    const double v = (static_cast<double>(row) + 0.5) * side - 0.5;
    here.planes[i] =
        plane(u, v, here.inverse[i], here.share.empty() ? 1 : double{here.share[i]}, found, kept);
  }
}

/// The plane of a patch around pixel (u, v) whose mean keeps `kept` of a pixel's variance.
DepthPlane DepthPlanes::plane(double u, double v, double inverse, double share, const Slope& slope,
                              double kept) const {
  // 1 / z = (a X + b Y + c Z) / Z, so that the plane is a X + b Y + c Z = 1.
  const double a = slope.u * camera_.fx, b = slope.v * camera_.fy;
  const double c = inverse - slope.u * (u - camera_.cx) - slope.v * (v - camera_.cy);
  const double h = 1 / std::sqrt(a * a + b * b + c * c);
  const double x = (u - camera_.cx) / camera_.fx, y = (v - camera_.cy) / camera_.fy;
  const double cosine = std::min(1.0, inverse * h / std::sqrt(x * x + y * y + 1));
  if (!(cosine >= kLeastCosine)) return {};
  const double z = 1 / inverse;
  const Grazing& grazing = grazing_[static_cast<std::size_t>(cosine * kCosineSteps + 0.5)];
  double axial = noise_.axial(z, 0);
  if (grazing.axial > 0) axial += grazing.axial * std::pow(z, noise_.power);
  const double lateral = noise_.metres + grazing.lateral * z;
  const double along = share * axial * cosine;
  const double variance = along * along + lateral * lateral * (1 - cosine * cosine);
  const double least = kLeastSigma * measure_.unit;
  const double reach = std::max(measure_.least_reach, measure_.sigmas * std::sqrt(variance));
  return {
      static_cast<float>(a * h),
      static_cast<float>(b * h),
      static_cast<float>(c * h),
      static_cast<float>(h),
      static_cast<float>(measure_.unit * measure_.unit / std::max(kept * variance, least * least)),
      static_cast<float>(std::min(reach, measure_.most_reach))};
}

/// A plane across the ray of one pixel.
DepthPlane DepthPlanes::pixel_plane(std::uint32_t u, std::uint32_t v) const {
  const Level& pixels = levels_[0];
  const std::size_t i = std::size_t{v} * camera_.width + u;
  if (!(pixels.inverse[i] > 0)) return {};
  const double z = 1 / double{pixels.inverse[i]};
  const double x = (u - camera_.cx) / camera_.fx, y = (v - camera_.cy) / camera_.fy;
  const double length = std::sqrt(x * x + y * y + 1);
  const double share = pixels.share.empty() ? 1 : double{pixels.share[i]};
  const double sigma = share * noise_.axial(z, 0), least = kLeastSigma * measure_.unit;
  const double reach = std::max(measure_.least_reach, measure_.sigmas * sigma);
  return {static_cast<float>(x / length),
          static_cast<float>(y / length),
          static_cast<float>(1 / length),
          static_cast<float>(z * length),
          static_cast<float>(kEdgeTrust * measure_.unit * measure_.unit /
                             std::max(sigma * sigma, least * least)),
          static_cast<float>(std::min(reach, measure_.most_reach))};
}

}  // namespace burnish
