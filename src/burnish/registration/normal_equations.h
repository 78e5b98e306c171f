#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "burnish/registration/pair.h"
#include "burnish/registration/twist.h"

namespace burnish {

/// A row of the Jacobian: rotation x, y, z, then translation x, y, z.
using TwistRow = std::array<double, 6>;

/// How n . x changes as x moves by a twist.
inline TwistRow moment_row(const Vec3d& x, const Vec3d& n) {
  const Vec3d m = cross(x, n);
  return {m.x, m.y, m.z, n.x, n.y, n.z};
}

/// The sums of a Gauss-Newton step: the upper triangle of J^T W J row by row, J^T W r.
struct NormalEquations {
  std::array<double, 21> matrix{};
  TwistRow gradient{};
  double weight = 0;   ///< sum of the weights times the variances that they are of
  double squares = 0;  ///< sum of weighted squared residuals
  std::size_t count = 0;

  void add(const TwistRow& row, double residual, double weight_of_row) {
    std::size_t k = 0;
    for (std::size_t i = 0; i < 6; ++i) {
      const double scaled = weight_of_row * row[i];
      for (std::size_t j = i; j < 6; ++j) matrix[k++] += scaled * row[j];
      gradient[i] += scaled * residual;
    }
    squares += weight_of_row * residual * residual;
    ++count;
  }
  NormalEquations& operator+=(const NormalEquations& b) {
    for (std::size_t k = 0; k < 21; ++k) matrix[k] += b.matrix[k];
    for (std::size_t i = 0; i < 6; ++i) gradient[i] += b.gradient[i];
    weight += b.weight, squares += b.squares, count += b.count;
    return *this;
  }
};

/// A Gauss-Newton step and by how much it changes the residuals, root mean square over the weight,
/// in units of their deviations.
struct GaussNewtonStep {
  Twist twist;
  double change = 0;
};

/// The matrix has the share `damping` of its mean diagonal added (Levenberg 1944), so that it does
/// not run where nothing holds it. None where nothing matched.
std::optional<GaussNewtonStep> solve(const NormalEquations& equations, double damping);

}  // namespace burnish
