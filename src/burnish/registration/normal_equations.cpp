#include "burnish/registration/normal_equations.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace burnish {
namespace {

/// The rotation by |v| about v (Rodrigues).
RigidTransform rotation_by(const Vec3d& v) {
  const double half = norm(v) / 2;
  const double scale = half > 1e-8 ? std::sin(half) / (2 * half) : 0.5;
  return rigid_from_quaternion(scale * v.x, scale * v.y, scale * v.z, std::cos(half), {});
}

}  // namespace

std::optional<GaussNewtonStep> solve(const NormalEquations& equations, double damping) {
  using Matrix = Eigen::Matrix<double, 6, 6>;
  using Vector = Eigen::Matrix<double, 6, 1>;
  if (equations.count < 6 || !(equations.weight > 0)) return {};
  Matrix matrix;
  std::size_t k = 0;
  for (Eigen::Index i = 0; i < 6; ++i) {
    for (Eigen::Index j = i; j < 6; ++j) {
      matrix(i, j) = matrix(j, i) = equations.matrix[k++];
    }
  }
  const Vector gradient = Eigen::Map<const Vector>(equations.gradient.data());
  Matrix damped = matrix;
  // Rotations and translations are of different units: each is damped by its own share.
  const double turns = matrix.topLeftCorner<3, 3>().trace() / 3;
  const double moves = matrix.bottomRightCorner<3, 3>().trace() / 3;
  for (Eigen::Index i = 0; i < 6; ++i) damped(i, i) += damping * (i < 3 ? turns : moves) + 1e-300;
  const Vector x = damped.ldlt().solve(-gradient);
  if (!x.allFinite()) return {};
  return GaussNewtonStep{{{x[0], x[1], x[2]}, {x[3], x[4], x[5]}},
                         std::sqrt(std::max(0.0, x.dot(matrix * x)) / equations.weight)};
}

RigidTransform moved(const RigidTransform& T, const Twist& twist) {
  RigidTransform step = rotation_by(twist.rotation);
  step.translation = twist.translation;
  const RigidTransform result = step * T;
  const auto [qx, qy, qz, qw] = quaternion(result);
  return rigid_from_quaternion(qx, qy, qz, qw, result.translation);
}

}  // namespace burnish
