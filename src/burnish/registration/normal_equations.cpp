#include "burnish/registration/normal_equations.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace burnish {
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

}  // namespace burnish
