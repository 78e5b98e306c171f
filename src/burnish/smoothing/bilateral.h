#pragma once

#include "burnish/base/schema.h"
#include "burnish/smoothing/smoothing.h"

namespace burnish {

struct BilateralParams {
  int iterations = 3;
  double relative_width = 1;  ///< sigma_c in mean edge lengths
  BoundaryRule boundary = BoundaryRule::fixed;

  static const Schema<BilateralParams>& schema();
};

/// Bilateral mesh denoising (Fleishman, Drori, Cohen-Or 2003): each vertex moves along its normal n
/// (the area-mean of its triangles') by
///     sum_q exp(-t^2 / (2 sigma_c^2)) exp(-h^2 / (2 sigma_s^2)) h / sum_q exp(...) exp(...),
///     t = |q - p|, h = <n, q - p>,
/// over the vertices q that are connected to it within 2 sigma_c, itself among them. sigma_c is
/// relative_width mean edge lengths. sigma_s, which the paper takes from a flat part that the user
/// picks, is the median over the vertices of the standard deviation of h; it and the neighbourhoods
/// are those of the mesh as it came. Where sigma_s is 0, most of the mesh being flat, all stays.
/// Jacobi.
///
/// What to expect: light noise goes with little shrinkage and hardly any drift; from a noise of
/// about a third of an edge on the normals are too noisy to move along. Boundary: fixed: stays;
/// free: moves along its normal like all else, so that it does not creep inwards; along_boundary:
/// the same, its neighbours being those along the boundary.
///
/// Normals that are there are computed anew, sigma stays (the safe side: how much a vertex averages
/// depends on what looked like an edge), all else too. O(iterations * relative_width^2 * #V).
/// Errors: invalid_argument, bad_geometry, cancelled; `mesh` is then unchanged.
Result<SmoothingReport> smooth_bilateral(TriangleMesh& mesh, const BilateralParams& params = {},
                                         const Context& context = {});

}  // namespace burnish
