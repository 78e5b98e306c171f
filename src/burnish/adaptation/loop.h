#pragma once

#include "burnish/adaptation/refinement.h"
#include "burnish/base/schema.h"

namespace burnish {

struct LoopParams {
  int iterations = 1;

  static const Schema<LoopParams>& schema();
};

/// Loop's subdivision (Loop 1987): every triangle becomes four, and the surface comes nearer to a
/// smooth one, C2 but for vertices of another valence than six, where it is C1. It lies within the
/// convex hull of its neighbourhood: rounded parts shrink.
///
/// A new vertex on an edge ab between triangles with third corners c and d lies at
/// 3/8 (a + b) + 1/8 (c + d); an old one with n neighbours q moves to (1 - n w) p + w sum q, with
/// w = (5/8 - (3/8 + cos(2 pi / n) / 4)^2) / n. On edges that do not have two triangles
/// (boundaries, non-manifold edges) new vertices lie in the middle, and an old vertex with two such
/// edges, to r and s, moves to 3/4 p + 1/8 (r + s): a cubic B-spline that depends on nothing but
/// the boundary (Hoppe et al. 1994). With one such edge, or more than two, it stays, and so do
/// vertices without triangles. Where a channel `refinement` confines the method, old vertices
/// without 1 stay, new ones between two such lie in the middle, and triangles around are cut in two
/// or three.
///
/// sigma of a vertex that moves becomes the mean of what it is made of, by the same weights (a
/// bound for the error of such a mean, however correlated its parts), where that is larger than its
/// own. Euler number, orientation and manifoldness are kept. O(#T log valence) a pass. Errors:
/// invalid_argument, bad_geometry, cancelled; `mesh` is then unchanged.
Result<RefinementReport> refine_loop(TriangleMesh& mesh, const LoopParams& params = {},
                                     const Context& context = {});

}  // namespace burnish
