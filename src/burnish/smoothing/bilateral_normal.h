#pragma once

#include "burnish/base/schema.h"
#include "burnish/smoothing/smoothing.h"

namespace burnish {

struct BilateralNormalParams {
  int iterations = 10;         ///< passes over the normals
  int vertex_iterations = 10;  ///< passes over the vertices, afterwards
  double sigma_s = 0.45;       ///< width of the range weight: a difference of unit normals, 0 to 2
  double equalizing = 0.3;     ///< share of the way amid its neighbours per vertex pass
  BoundaryRule boundary = BoundaryRule::fixed;

  static const Schema<BilateralNormalParams>& schema();
};

/// Face normals are filtered bilaterally, then the vertices follow them (Zheng, Fu, Au, Tai 2011,
/// local scheme, eq. 3): each normal becomes the normalised
///     sum_j A_j exp(-|c_i - c_j|^2 / (2 sigma_c^2)) exp(-|n_i - n_j|^2 / (2 sigma_s^2)) n_j
/// over the face itself and all that share a vertex with it, with areas A, centroids c and sigma_c
/// the mean distance of the centroids of faces that share an edge. Vertices are moved as
/// vertex_update.h says (Sun et al. 2007; equalizing = 0 is theirs but for weights by area).
///
/// What to expect: flat parts become flat and edges stay sharp where they differ by more than
/// sigma_s and the noise; where noise turns normals as far as an edge does, it is kept like an
/// edge. Nearly no shrinkage. Noise within the surface (lateral) stays but where `equalizing` acts.
/// Boundary: fixed: stays; free: follows the normals like all else, and does not creep inwards;
/// along_boundary: each vertex on it moves once to the mean of itself and its neighbours along it.
///
/// Normals that are there are computed anew, sigma stays (the safe side), all else too.
/// O((iterations * 13 + vertex_iterations) * #T). Errors: invalid_argument, bad_geometry,
/// cancelled; `mesh` is then unchanged.
Result<SmoothingReport> smooth_bilateral_normal(TriangleMesh& mesh,
                                                const BilateralNormalParams& params = {},
                                                const Context& context = {});

}  // namespace burnish
