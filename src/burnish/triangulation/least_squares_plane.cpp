#include "burnish/triangulation/least_squares_plane.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace burnish {
namespace {

/// Points that vary so much less across than along are on a line, m2/m2.
constexpr double kLine = 1e-6;

}  // namespace

Vec3d least_squares_normal(std::span<const Vec3f> positions, std::uint32_t point,
                           std::span<const Neighbour> neighbours) {
  if (neighbours.size() < 2) return {};
  const Vec3d origin(positions[point]);
  const double n = static_cast<double>(neighbours.size()) + 1;
  Vec3d mean;
  for (const Neighbour& q : neighbours) mean += Vec3d(positions[q.index]) - origin;
  mean = mean / n;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  const auto add = [&covariance](const Vec3d& d) {
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c <= r; ++c) {
        covariance(r, c) += d[static_cast<std::size_t>(r)] * d[static_cast<std::size_t>(c)];
      }
    }
  };
  add(mean);
  for (const Neighbour& q : neighbours) add(Vec3d(positions[q.index]) - origin - mean);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  if (!(solver.eigenvalues()(1) > kLine * solver.eigenvalues()(2))) return {};
  const Vec3d normal{solver.eigenvectors()(0, 0), solver.eigenvectors()(1, 0),
                     solver.eigenvectors()(2, 0)};
  const double largest = std::max({normal.x, normal.y, normal.z});
  const double smallest = std::min({normal.x, normal.y, normal.z});
  return largest < -smallest ? -normal : normal;
}

}  // namespace burnish
