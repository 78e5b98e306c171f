#include "burnish/triangulation/point_moments.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cstdint>

namespace burnish {
namespace {

__extension__ using Wide = __int128;

constexpr double kSteps = 1073741824;  // 2^30

/// The direction of least variance; of the two the one that looks up.
Vec3d least_direction(const Eigen::Matrix3d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  const Eigen::Vector3d v = solver.eigenvectors().col(0);
  const Vec3d normal{v(0), v(1), v(2)};
  const double side = normal.z != 0 ? normal.z : normal.y != 0 ? normal.y : normal.x;
  return side < 0 ? -normal : normal;
}

}  // namespace

PointMoments moments(std::span<const Vec3f> points) {
  PointMoments result;
  Vec3d low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high = -low;
  for (const Vec3f& p : points) {
    if (!is_finite(p)) continue;
    ++result.count;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min<double>(low[axis], p[axis]);
      high[axis] = std::max<double>(high[axis], p[axis]);
    }
  }
  if (result.count == 0) return result;
  const Vec3d size = high - low;
  const double extent = std::max({size.x, size.y, size.z});
  const double scale = extent > 0 ? kSteps / extent : 0;

  // Each sum has less than 32 + 60 bits, each product below less than 125.
  std::array<Wide, 3> sum{};
  std::array<std::array<Wide, 3>, 3> product_sum{};
  for (const Vec3f& p : points) {
    if (!is_finite(p)) continue;
    const Vec3d steps = (Vec3d(p) - low) * scale;
    const std::array<std::int64_t, 3> q{std::llround(steps.x), std::llround(steps.y),
                                        std::llround(steps.z)};
    for (std::size_t r = 0; r < 3; ++r) {
      sum[r] += q[r];
      for (std::size_t c = 0; c <= r; ++c) product_sum[r][c] += q[r] * q[c];
    }
  }
  const auto count = static_cast<Wide>(result.count);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t r = 0; r < 3; ++r) {
    if (scale > 0) {
      result.mean[r] = static_cast<double>(sum[r]) / static_cast<double>(count) / scale;
    }
    for (std::size_t c = 0; c <= r; ++c) {
      covariance(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) =
          static_cast<double>(count * product_sum[r][c] - sum[r] * sum[c]);
    }
  }
  result.mean += low;
  result.least_direction = least_direction(covariance);
  return result;
}

}  // namespace burnish
