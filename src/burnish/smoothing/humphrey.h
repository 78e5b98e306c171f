#pragma once

#include "burnish/base/schema.h"
#include "burnish/smoothing/smoothing.h"

namespace burnish {

struct HumphreyParams {
  double alpha = 0;   ///< how far vertices are pulled back to where they were at first
  double beta = 0.5;  ///< a vertex's own share in how far it is pushed back
  int iterations = 10;
  BoundaryRule boundary = BoundaryRule::fixed;

  static const Schema<HumphreyParams>& schema();
};

/// HC smoothing (Vollmer, Mencl and Mueller 1999, "HC-modified Laplacian"): every vertex moves to
/// the mean of its one-ring, and is then pushed back by what it and its neighbours moved on
/// average. With o the positions at first and q those before the pass:
///     p_i = mean_j q_j,   b_i = p_i - (alpha o_i + (1 - alpha) q_i),
///     p_i' = p_i - (beta b_i + (1 - beta) mean_j b_j)
/// Waves of frequency k are multiplied by 1 - (1 - beta) k^2 (alpha = 0): only those that are a few
/// edges long are touched, so that it hardly shrinks. It needs more passes than smooth_taubin
/// against noise of the same size, and leaves longer waves of it. Blurs features.
///
/// Jacobi. A vertex that stays (on the boundary, or pinned) has b = 0; a smoothing weight takes
/// that share of the move of each whole pass. boundary: along_boundary
/// smooths boundary loops as curves. Normals that are there are computed anew, all else stays, also
/// sigma: the push back undoes part of the averaging, by how much depends on the spectrum of the
/// noise; to claim nothing is on the safe side. O(iterations * #T). Errors: invalid_argument,
/// bad_geometry, cancelled; `mesh` is then unchanged.
Result<SmoothingReport> smooth_humphrey(TriangleMesh& mesh, const HumphreyParams& params = {},
                                        const Context& context = {});

}  // namespace burnish
