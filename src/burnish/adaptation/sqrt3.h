#pragma once

#include "burnish/adaptation/refinement.h"
#include "burnish/base/schema.h"

namespace burnish {

struct Sqrt3Params {
  int iterations = 1;

  static const Schema<Sqrt3Params>& schema();
};

/// The square root of three subdivision (Kobbelt 2000): every triangle becomes three by a vertex at
/// its centroid, and then the old edges are flipped. Two passes cut every edge in three and make
/// nine triangles of one. The surface comes nearer to a smooth one, C2 but for vertices of another
/// valence than six, where it is C1. It grows more slowly than by Loop's subdivision, and nothing
/// around a zone has to be cut to fit it.
///
/// An old vertex with n neighbours q moves to (1 - w) p + w / n sum q, where
/// w = (4 - 2 cos(2 pi / n)) / 9. Edges that cannot be flipped are creases: boundaries,
/// non-manifold edges, those between triangles whose orientations disagree or that have the same
/// three corners. An odd pass leaves creases and their vertices as they are. An even one cuts
/// creases, and with them the triangles along them, in three by a cubic B-spline: a vertex on
/// exactly two creases, to r and s, goes to (4 r + 19 p + 4 s) / 27, and the new one beside it on
/// the way to s lies at (r + 16 p + 10 s) / 27. Beside other vertices, which stay, it lies at a
/// third of the edge. Vertices without triangles stay.
///
/// Where a channel `refinement` confines the method, triangles without a corner that has 1 stay as
/// they are, edges between them and the others are not flipped, and old vertices without 1 stay.
///
/// Every triangle that is refined becomes three. sigma of moved vertices, Euler number, orientation
/// and manifoldness as with refine_loop. O(#T log valence) a pass. Errors: invalid_argument,
/// bad_geometry, cancelled; `mesh` is then unchanged.
Result<RefinementReport> refine_sqrt3(TriangleMesh& mesh, const Sqrt3Params& params = {},
                                      const Context& context = {});

}  // namespace burnish
