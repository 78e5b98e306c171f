#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "burnish/base/facts.h"
#include "burnish/base/rigid.h"
#include "burnish/base/schema.h"

namespace burnish {

/// A small motion x -> x + rotation x x + translation: about the origin of the target's
/// coordinates (rad, along its axes), then along them (m).
struct Twist {
  Vec3d rotation, translation;
};

/// Symmetric, of twists: rotation x, y, z, then translation x, y, z.
using Matrix6 = std::array<std::array<double, 6>, 6>;

/// Why a pair is not to be relied on.
enum class Refusal {
  not_converged,         ///< the steps did not get small
  too_little_overlap,    ///< too small a share of the source has a counterpart
  residual_above_noise,  ///< counterparts differ by more than both sensors' noise
  contradiction,         ///< one shows surface where the other saw through
  not_held,              ///< in some direction the surfaces slide along each other
  ambiguous,             ///< another pose explains the data as well (global start)
};

std::string_view to_string(Refusal refusal);

/// What a pair must show to be relied on.
struct AcceptanceParams {
  double min_overlap = 0.2;
  double max_rmse = 1.3;
  double max_contradiction = 0.01;
  double min_significance = 4;
  double max_deviation = 0.02;  ///< m

  static const Schema<AcceptanceParams>& schema();
};

/// The motion that the data hold least: of all that move the matched points by the same mean square
/// the one that changes the residuals least.
struct WeakDirection {
  Vec3d axis;               ///< unit length, in target axes: moved along it or turned about it
  bool turn = false;        ///< whether the points' motion is mostly a rotation about their centre
  double eigenvalue = 0;    ///< of the information, rotations scaled by the scene's radius, 1/m^2
  double deviation = 0;     ///< 1 / sqrt(eigenvalue), m; infinite where nothing holds
  double significance = 0;  ///< eigenvalue over what noisy normals make of one that is 0
};

/// How two views of one scene lie to each other, how well that is known, and whether it is to be
/// relied on. The pose is always the best that was found; only that of an accepted pair may be used
/// as if it were true.
struct PairRegistration {
  RigidTransform T_target_source;

  std::size_t points = 0;    ///< of the source that were looked at
  std::size_t matched = 0;   ///< of them, those with a counterpart within three deviations
  double overlap = 0;        ///< matched / points
  double agreement = 0;      ///< matched / (those that the target could see)
  double contradiction = 0;  ///< the share of what both could see that one saw through; the larger
                             ///< of both directions
  double inlier_rmse = 0;    ///< of the matched, in units of the expected noise: 1 is as expected

  /// Of a twist e with T_true = (1 + e) T_target_source. Errors of neighbouring measurements are
  /// shared, which both take into account; what normals err adds nothing to the information.
  Matrix6 covariance{}, information{};
  Vec3d centre;       ///< the mean of the matched points, target coordinates
  double radius = 0;  ///< root mean square of their distance from it, m
  WeakDirection weakest;

  int iterations = 0;
  bool converged = false;

  std::vector<Refusal> refusals;  ///< empty: accepted
  std::string reason;             ///< in words, with numbers; empty where accepted

  bool accepted() const { return refusals.empty(); }
  Facts facts() const;
};

}  // namespace burnish
