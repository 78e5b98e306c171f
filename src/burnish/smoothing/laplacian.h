#pragma once

#include "burnish/base/schema.h"
#include "burnish/smoothing/smoothing.h"

namespace burnish {

/// How the neighbours of a vertex are weighed.
enum class LaplacianWeights {
  uniform,    ///< all alike: the umbrella operator
  cotangent,  ///< cot a + cot b of the angles opposite to the edge: moves along the normal
};

struct LaplacianParams {
  LaplacianWeights weights = LaplacianWeights::uniform;
  double lambda = 0.5;  ///< the share of the way to the mean that one pass goes
  int iterations = 5;
  BoundaryRule boundary = BoundaryRule::fixed;

  static const Schema<LaplacianParams>& schema();
};

/// Each vertex goes a share of the way to the weighted mean of its one-ring:
///     p' = p + lambda (sum w_j p_j / sum w_j - p)
/// with w_j = 1 (Taubin 1995, section 2; Kobbelt et al. 1998) or w_j = cot a_j + cot b_j (Pinkall
/// and Polthier 1993; Desbrun et al. 1999, section 5.1), where a_j and b_j are the angles opposite
/// to the edge to neighbour j.
///
/// The weights are divided by their sum, also the cotangents (the normalised curvature operator of
/// Desbrun et al.): a curvature flow whose steps have their own length at each vertex. Like this
/// every step up to lambda = 1 is stable, on any mesh, where steps of equal time would have to stay
/// below the square of the shortest edge. Where cot a_j + cot b_j < 0 (the edge is not Delaunay) it
/// counts as 0, which keeps each vertex within the hull of its ring; where all are 0 the vertex
/// stays. Angles below 1e-3 rad count as that.
///
/// Jacobi. Shrinks, blurs features. Uniform weights also even the triangles; cotangents leave
/// them as they are and move (nearly) along the normal. boundary: along_boundary moves boundary
/// vertices with equal weights along the boundary; free counts the one angle that there is.
/// Normals that are there are computed anew, sigma follows as for smooth_one_ring_mean, all else
/// stays. O(iterations * #T). Errors: invalid_argument, bad_geometry, cancelled; `mesh` is then
/// unchanged.
Result<SmoothingReport> smooth_laplacian(TriangleMesh& mesh, const LaplacianParams& params = {},
                                         const Context& context = {});

}  // namespace burnish
