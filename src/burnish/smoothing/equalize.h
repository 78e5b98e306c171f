#pragma once

#include "burnish/base/schema.h"
#include "burnish/smoothing/smoothing.h"

namespace burnish {

struct EqualizeParams {
  double step = 0.4;  ///< the share of the way to the weighted mean that one pass goes
  int iterations = 5;
  BoundaryRule boundary = BoundaryRule::fixed;

  static const Schema<EqualizeParams>& schema();
};

/// Evens the distances to the neighbours without smoothing the surface: what Eq. 1 of Ozbay and
/// Cinar is meant to do (near and far neighbours count more than others), without its harm. Every
/// vertex moves in its tangent plane towards the mean of its one-ring, weighted by distance:
///     d = sum w_j (p_j - p) / sum w_j,  w_j = |p_j - p|,   p' = p + step (d - n (n . d))
/// with n the area-weighted normal of the triangles at the vertex, computed anew in each pass. Far
/// neighbours pull more than near ones, continuously: a slight change of positions changes the
/// result slightly. Steps up to 0.5 are stable: the sum of |e| e over edges e changes 3/2 times as
/// fast as that of e in a plane and twice as fast on a line, and frequencies go up to 3/2 and 2.
/// This project's own method.
///
/// No vertex moves along its normal, so that noise stays, and so do size and volume to first order;
/// across a crease vertices slide off it, which rounds it. Jacobi. boundary: along_boundary lets
/// boundary vertices slide along the line through their two boundary neighbours (where there are
/// not two of them they stay); free lets boundaries creep inwards within the surface. Vertices
/// whose triangles have no area stay. Normals that are there are computed anew, all else stays,
/// also sigma: across the surface, where it counts, nothing is averaged.
/// O(iterations * #T). Errors: invalid_argument, bad_geometry, cancelled; `mesh` is then unchanged.
Result<SmoothingReport> smooth_equalize(TriangleMesh& mesh, const EqualizeParams& params = {},
                                        const Context& context = {});

}  // namespace burnish
