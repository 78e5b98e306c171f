#pragma once

#include "burnish/base/schema.h"
#include "burnish/smoothing/smoothing.h"

namespace burnish {

struct GuidedNormalParams {
  int iterations = 20;         ///< rounds: normals filtered once, then the vertices moved
  int vertex_iterations = 10;  ///< passes over the vertices in each round
  double relative_radius = 2;  ///< of the neighbourhood, in mean centroid distances
  double sigma_r = 0.35;       ///< width of the range weight: a difference of unit normals, 0 to 2
  double equalizing = 0.3;     ///< share of the way amid its neighbours per vertex pass
  BoundaryRule boundary = BoundaryRule::fixed;

  static const Schema<GuidedNormalParams>& schema();
};

/// Guided mesh normal filtering (Zhang, Deng, Zhang, Bouaziz, Liu 2015). In each round every face
/// gets a guidance normal g, that of the patch around it that is most of one piece
/// (patch_guidance.h), its normal becomes the normalised
///     sum_j A_j exp(-|c_i - c_j|^2 / (2 d^2)) exp(-|g_i - g_j|^2 / (2 sigma_r^2)) n_j
/// over the faces j that are connected to it within relative_radius * d (eq. 3), and the vertices
/// are moved as vertex_update.h says (Sun et al. 2007; equalizing = 0 is theirs but for weights by
/// area). d is the mean distance of the centroids of faces that share an edge. It and the
/// neighbourhoods are those of the mesh as it came.
///
/// What to expect: as bilateral_normal, but edges survive more noise, since the guidance is less
/// noisy than what it guides. Round parts are cut into small facets where there is little noise.
/// Who is of one piece is a choice between patches: a difference in the last bit of a position may
/// lead to another one. Boundary: fixed: stays; free: follows the normals like all else, and does
/// not creep inwards; along_boundary: each vertex on it moves once in each round to the mean of
/// itself and its neighbours along it.
///
/// Normals that are there are computed anew, sigma stays (the safe side), all else too.
/// O(iterations * (300 + 10 * vertex_iterations) * #T). Errors: invalid_argument, bad_geometry,
/// cancelled; `mesh` is then unchanged.
Result<SmoothingReport> smooth_guided_normal(TriangleMesh& mesh,
                                             const GuidedNormalParams& params = {},
                                             const Context& context = {});

}  // namespace burnish
