#pragma once

#include "burnish/base/schema.h"
#include "burnish/smoothing/smoothing.h"

namespace burnish {

struct OneRingMeanParams {
  int iterations = 1;
  BoundaryRule boundary = BoundaryRule::fixed;

  static const Schema<OneRingMeanParams>& schema();
};

/// Each vertex moves to the mean of its one-ring and itself: p' = (p + sum p_j) / (n + 1). This,
/// not Eq. 1, is what Figure 6 of Ozbay and Cinar tabulates. Jacobi; shrinks; blurs features; evens
/// the triangles. Normals that are there are computed anew, sigma follows (it shrinks by about
/// sqrt(7 * iterations) where errors are independent), all else stays. O(iterations * #T).
/// Errors: invalid_argument, bad_geometry, cancelled; `mesh` is then unchanged.
Result<SmoothingReport> smooth_one_ring_mean(TriangleMesh& mesh,
                                             const OneRingMeanParams& params = {},
                                             const Context& context = {});

}  // namespace burnish
