#pragma once

#include "burnish/base/context.h"
#include "burnish/base/facts.h"
#include "burnish/core/point_cloud.h"
#include "burnish/triangulation/adaptive_fan_cloud.h"

namespace burnish {

/// How many points should be left. With nothing set: half of them.
struct FanThinningParams {
  int target_points = 0;  ///< 0: no such target
  double ratio = 0;       ///< of points to keep; 0: no such target
  InformationWeights weights{};

  static const Schema<FanThinningParams>& schema();
};

struct FanThinningReport {
  std::size_t points_before = 0;  ///< with a position (missing pixels do not count)
  std::size_t points = 0;
  double least_information = 0;    ///< of the points that went, when they went
  double largest_information = 0;  ///< the same

  Facts facts() const;
};

/// Takes the points away that carry least information, one after the other, as an AdaptiveFanCloud
/// measures it, until the target is reached, of two the larger. The order does not depend on that
/// of the points. Those that are left are not moved, keep their attributes and their order; the
/// grid of an organized cloud goes. O(k) fans of O(log #P + k log k) each a point.
/// Errors: invalid_argument, bad_geometry, cancelled; `cloud` is then unchanged.
Result<FanThinningReport> thin_by_fans(PointCloud& cloud, const FanThinningParams& params = {},
                                       const Context& context = {});

/// The same of the points that `where` names by their numbers in `cloud`: of them alone so many are
/// to be left, and no other goes.
Result<FanThinningReport> thin_by_fans(PointCloud& cloud, const PointSelection& where,
                                       const FanThinningParams& params = {},
                                       const Context& context = {});

}  // namespace burnish
