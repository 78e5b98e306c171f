#pragma once

#include <numbers>

#include "burnish/base/context.h"
#include "burnish/base/schema.h"
#include "burnish/core/point_cloud.h"
#include "burnish/points/cleaning.h"

namespace burnish {

struct FlyingPixelParams {
  double max_angle = 80 * std::numbers::pi / 180;  ///< between ray and normal, rad
  int min_patch = 20;                              ///< pixels of the smallest patch that stays

  static const Schema<FlyingPixelParams>& schema();
};

/// Takes from an organized cloud what depth cameras invent at the edges of things:
///   1. pixels between two surfaces: along a row, a column or a diagonal one neighbour lies nearer
///      by a depth jump, the opposite one farther;
///   2. pixels seen at more than `max_angle`, where the cloud has normals;
///   3. patches of fewer than `min_patch` pixels that depth jumps cut off from all others.
/// A depth jump is more than three sigma and what a surface tilted by 75 degrees explains; sigma is
/// the cloud's or, where it has none, estimated from the grid. Removed points become missing: NaN,
/// their normals, sigma, noise and observations 0. Without a viewpoint the origin is taken for it.
/// O(#P). Errors: invalid_argument, bad_geometry (also where the cloud has no grid), cancelled;
/// `cloud` is then unchanged.
Result<CleaningReport> remove_flying_pixels(PointCloud& cloud, const FlyingPixelParams& params = {},
                                            const Context& context = {});

}  // namespace burnish
