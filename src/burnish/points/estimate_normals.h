#pragma once

#include "burnish/base/context.h"
#include "burnish/base/facts.h"
#include "burnish/base/schema.h"
#include "burnish/core/point_cloud.h"

namespace burnish {

struct NormalParams {
  int neighbours = 16;  ///< of an unorganized cloud, the point itself among them
  int window = 0;       ///< radius in the grid of an organized cloud, pixels; 0: sized by the noise

  static const Schema<NormalParams>& schema();
};

/// What the estimation of normals did.
struct NormalReport {
  std::size_t points = 0;   ///< with a position
  std::size_t unknown = 0;  ///< of them without a normal: too few others around, or all in a line
  std::size_t components = 0;  ///< oriented each on its own; 0 where there is a viewpoint

  Facts facts() const {
    return {{"points", static_cast<double>(points), ""},
            {"unknown", static_cast<double>(unknown), ""},
            {"components", static_cast<double>(components), ""}};
  }
};

/// Gives every point a normal of unit length, 0 where none can be known.
/// Organized: least-squares plane of inverse depth in a window that ends at depth jumps, towards
/// the viewpoint, for which the origin stands where the cloud names none. O(#P * window).
/// Unorganized: direction of least variance of the `neighbours` nearest points, in double; where
/// these lie along a line, that of the plane of the line and of the nearest points beside it.
/// Towards the viewpoint, or without one consistent along a minimum spanning tree of the
/// neighbours, whose weights are 1 - |cos| of the mirrored normals (after Hoppe et al. 1992,
/// section 3.3); in each component the points farthest out along the six axes look outwards, and
/// where these contradict each other that of largest z looks up: closed surfaces look outwards.
/// O(#P k log #P). Errors: invalid_argument, bad_geometry, cancelled; `cloud` is then unchanged.
Result<NormalReport> estimate_normals(PointCloud& cloud, const NormalParams& params = {},
                                      const Context& context = {});

}  // namespace burnish
