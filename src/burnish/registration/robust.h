#pragma once

#include <cmath>

#include "burnish/registration/evidence.h"
#include "burnish/registration/normal_equations.h"

namespace burnish {

// What the iterations over frames and over clouds have in common.

/// Tukey's biweight: residuals beyond so many deviations weigh nothing (95 % efficient on normal
/// errors, Holland and Welsch 1977).
inline constexpr double kTukey = 4.685;
inline constexpr double kLikeNormals = 0.5;  ///< cos 60 degrees
inline constexpr double kInlier = 3;         ///< deviations
inline constexpr double kGraduation = 3;     ///< by which the tolerance falls from level to level
inline constexpr double kFineDamping = 1e-6;
inline constexpr double kCoarseDamping = 1e-3;

/// The weight of a residual whose square is so many variances.
inline double tukey_weight(double squared) {
  const double inside = 1 - squared / (kTukey * kTukey);
  return inside > 0 ? inside * inside : 0;
}

/// Whether a step is as good as none: on the finest level where it is a tenth of the deviation of
/// the pose, whose measurements share their noise among `noise_points`; on others where it changes
/// the residuals by a hundredth of their tolerance, root mean square.
inline bool is_still(const GaussNewtonStep& step, const NormalEquations& sums, bool finest,
                     double noise_points) {
  return step.change < (finest ? 0.1 * std::sqrt(noise_points / sums.weight) : 1e-2);
}

}  // namespace burnish
