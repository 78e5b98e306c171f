#pragma once

#include "burnish/base/schema.h"
#include "burnish/smoothing/smoothing.h"

namespace burnish {

struct GaussianParams {
  int iterations = 1;
  double relative_width = 1;  ///< s in mean edge lengths
  BoundaryRule boundary = BoundaryRule::fixed;

  static const Schema<GaussianParams>& schema();
};

/// Each vertex moves to the mean of itself (weight 1) and its one-ring, near neighbours counting
/// more:
///     p' = (p + sum w_j p_j) / (1 + sum w_j),   w_j = exp(-|p_j - p|^2 / (2 s^2))
/// where s is relative_width mean edge lengths of the mesh as it came. What Ozbay and Cinar call
/// Gaussian smoothing and compare with; they print no formula, this is the usual one. Jacobi;
/// shrinks; blurs features. Normals that are there are computed anew, sigma follows, all else
/// stays. O(iterations * #T). Errors: invalid_argument, bad_geometry, cancelled; `mesh` is then
/// unchanged.
Result<SmoothingReport> smooth_gaussian(TriangleMesh& mesh, const GaussianParams& params = {},
                                        const Context& context = {});

}  // namespace burnish
