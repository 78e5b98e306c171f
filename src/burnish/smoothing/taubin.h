#pragma once

#include "burnish/base/schema.h"
#include "burnish/smoothing/smoothing.h"

namespace burnish {

struct TaubinParams {
  double lambda = 0.5;   ///< the step towards the mean of the ring
  double mu = -0.53;     ///< the step back
  double pass_band = 0;  ///< in place of mu, where it is not 0: k_PB = 1 / lambda + 1 / mu
  int iterations = 10;   ///< of two passes each
  BoundaryRule boundary = BoundaryRule::fixed;

  static const Schema<TaubinParams>& schema();
};

/// Low-pass smoothing without shrinkage (Taubin 1995, section 3): each iteration makes two passes
/// of the umbrella operator U(p) = mean of the one-ring less p, a step towards the mean and one
/// back:
///     p' = p + lambda U(p),   p'' = p' + mu U(p')
/// Waves of frequency k (0 to 2, eigenvalues of -U) are multiplied by (1 - lambda k)(1 - mu k) in
/// each iteration: those below the pass band k_PB = 1 / lambda + 1 / mu (0.113 at the defaults)
/// stay or grow slightly (by 0.1 % per iteration), those above die out. Does not shrink to first
/// order; blurs features; evens the triangles.
///
/// Set either mu or pass_band (Taubin advises 0.01 to 0.1). With mu > -lambda it shrinks. Where
/// (1 - 2 lambda)(1 - 2 mu) < -1 the highest frequencies may grow; settings that make positions
/// leave the range of float are an error.
///
/// Jacobi. boundary: along_boundary filters boundary loops as curves; free lets them creep, though
/// with this method only by what is above the pass band. Normals that are there are computed
/// anew, all else stays, also sigma: the step back undoes part of the averaging, and frequencies in
/// the pass band keep all their noise, so how much is averaged away depends on the noise's
/// spectrum; to claim nothing is on the safe side. O(iterations * #T). Errors: invalid_argument,
/// bad_geometry, cancelled; `mesh` is then unchanged.
Result<SmoothingReport> smooth_taubin(TriangleMesh& mesh, const TaubinParams& params = {},
                                      const Context& context = {});

}  // namespace burnish
