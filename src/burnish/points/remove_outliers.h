#pragma once

#include "burnish/base/context.h"
#include "burnish/base/schema.h"
#include "burnish/core/point_cloud.h"
#include "burnish/points/cleaning.h"

namespace burnish {

struct OutlierParams {
  int neighbours = 8;  ///< the k of the k-th nearest neighbour
  double factor = 3;   ///< of the neighbourhood's own distances, beyond which a point is an outlier

  static const Schema<OutlierParams>& schema();
};

/// Takes out points that lie alone: whose distance to the k-th nearest neighbour is more than
/// `factor` times the median of the same distance at these k neighbours. Both sides of the
/// comparison scale with the sampling, so that sparse regions stay; a clump of at most k / 2 points
/// goes, as most neighbours of its points are far away in the crowd. Clouds of k points or fewer
/// stay as they are. Removed points of an organized cloud become missing (NaN). One pass. O(#P k).
/// Errors: invalid_argument, bad_geometry, cancelled; `cloud` is then unchanged.
Result<CleaningReport> remove_outliers(PointCloud& cloud, const OutlierParams& params = {},
                                       const Context& context = {});

}  // namespace burnish
