#include "burnish/points/precision.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace burnish {

Precision precision_of(const PointNoise& noise, double least) {
  const double along = std::max<double>(noise.along, least);
  const double across = std::max<double>(noise.across, least);
  const double round = 1 / (across * across), more = 1 / (along * along) - round;
  const Vec3d a(noise.axis);
  return {round + more * a.x * a.x, round + more * a.y * a.y, round + more * a.z * a.z,
          more * a.x * a.y,         more * a.y * a.z,         more * a.z * a.x};
}

PointNoise noise_within(const Precision& precision, const Vec3f& normal) {
  const auto& [xx, yy, zz, xy, yz, zx] = precision;
  Eigen::Matrix3d matrix;
  matrix << xx, xy, zx, xy, yy, yz, zx, yz, zz;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
  const Eigen::Vector3d& values = solver.eigenvalues();  // ascending: the first is the longest axis
  std::array<double, 3> radius{};
  for (Eigen::Index i = 0; i < 3; ++i) {
    radius[static_cast<std::size_t>(i)] = 1 / std::sqrt(std::max(values[i], 1e-6 * values[2]));
  }
  const auto [longest, middle, shortest] = radius;
  // Long about the longest axis, or flat about the shortest: whichever holds more.
  const bool is_long = longest * shortest >= middle * middle;
  const Eigen::Vector3d v = solver.eigenvectors().col(is_long ? 0 : 2);
  const Vec3d axis{v.x(), v.y(), v.z()};
  return {Vec3f(dot(axis, Vec3d(normal)) > 0 ? -axis : axis),
          static_cast<float>(is_long ? longest : shortest),
          static_cast<float>(is_long ? shortest : middle)};
}

}  // namespace burnish
