#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/facts.h"
#include "burnish/base/result.h"
#include "burnish/registration/pair.h"
#include "burnish/registration/pose_model.h"

namespace burnish {

/// What a registered pair says of the poses of its views.
struct PoseConstraint {
  std::uint32_t target, source;  ///< views
  RigidTransform T_target_source;
  Matrix6 information;  ///< of a twist in target axes (PairRegistration::information)
};

/// How poses fit what pairs say of them.
struct PoseFit {
  int iterations = 0;
  bool converged = false;
  /// Per constraint how far the poses are from it, in its deviations: the root of e^T information
  /// e / 6, about 1 where all is as expected.
  std::vector<double> deviations;
  std::vector<bool> contradicted;  ///< per constraint: left out, since it does not fit the others

  Facts facts() const;
};

/// Moves `poses` to where they fit the constraints best in the sense of least squares:
///   sum e^T information e,   moved(T_target_source, e) = T_world_target^-1 T_world_source
/// (Lu and Milios 1997), by Levenberg and Marquardt's method with a sparse factorisation. A
/// constraint that is more than `max_deviation` deviations off, the worst first, is left out and
/// the poses are fitted anew, as long as its views stay joined by others. Views that no constraint
/// joins to the first stay where they are. One thread: the same bytes always. O(iterations * (#
/// constraints + fill-in)).
/// Errors: invalid_argument where a constraint names a view that is not there, or one view twice,
/// or its information is not finite; cancelled.
Result<PoseFit> fit_poses(PoseModel& poses, std::span<const PoseConstraint> constraints,
                          double max_deviation, const Context& context = {});

/// Per view the covariance of the twist by which its pose may be off as seen from the view
/// `reference`, in that one's axes, as the constraints that are not `contradicted` tell. Of a view
/// that they do not join to it the numbers are enormous. Errors: as fit_poses.
Result<std::vector<Matrix6>> pose_covariances(const PoseModel& poses,
                                              std::span<const PoseConstraint> constraints,
                                              const std::vector<bool>& contradicted,
                                              std::size_t reference, const Context& context = {});

/// One standard deviation of where a twist of covariance `covariance` takes the point x, in the
/// direction in which it is largest, m.
double deviation_at(const Matrix6& covariance, const Vec3d& x);

}  // namespace burnish
