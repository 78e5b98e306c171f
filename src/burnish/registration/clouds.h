#pragma once

#include "burnish/base/context.h"
#include "burnish/core/point_cloud.h"
#include "burnish/registration/pair.h"

namespace burnish {

/// What makes two points counterparts of one surface.
enum class CloudError {
  point_to_plane,  ///< the distance from the target's plane
  generalized,     ///< both points lie in planes of their own
};

struct CloudsParams {
  CloudError error = CloudError::generalized;
  double reach = 0;           ///< m; how far off the guess may put the surfaces; 0: a sixth of the
                              ///< target's radius
  int samples = 20000;        ///< points of the source on the finest level
  int levels = 3;             ///< each coarser one takes a third of them
  int max_iterations = 50;    ///< on each level
  double distortion = 0.002;  ///< systematic error of 1/z where a cloud has a viewpoint, 1/m
  AcceptanceParams acceptance{};

  static const Schema<CloudsParams>& schema();
};

/// How the cloud `source` lies in the world of `target`, from a guess: T_target_source maps world
/// coordinates of the one to those of the other.
///
/// Iterated closest points (Besl and McKay 1992) over a sample of the source, whose counterparts
/// are the nearest points of the target where the normals agree within 60 degrees (either way round
/// where they were estimated without a viewpoint). With d = x - q, n the target's and m the
/// source's normal, and Tukey's biweight of the residual:
///   point_to_plane  (n . d)^2 / (sigma_x^2 + sigma_q^2 + bias_x^2 + bias_q^2 + t^2)
///   generalized     d^T (C_q + C_x)^-1 d, C = s^2 (n n^T + 1000 (1 - n n^T)) of either point, with
///                   s^2 = sigma^2 + bias^2 + t^2 / 2 (Segal, Haehnel and Thrun 2009, eq. 2 and
///                   section III.B): both lie in planes as thin as the sensor measures them
/// sigma is the clouds' own (attributes.sigma), or what a point's neighbours scatter about their
/// plane by. Robust weights, t and the way from coarse to fine are those of register_projective.
///
/// The verdict is of the same kind, but that nothing tells free space here: what contradicts are
/// points that lie over the target's surface, with a like normal, and off it by more than five
/// deviations, in either direction. The same bytes for any number of threads. Building O(#P log
/// #P), a step O(samples). Errors: invalid_argument, bad_geometry, cancelled.
Result<PairRegistration> register_clouds(const PointCloud& source, const PointCloud& target,
                                         const RigidTransform& T_target_source_guess = {},
                                         const CloudsParams& params = {},
                                         const Context& context = {});

}  // namespace burnish
