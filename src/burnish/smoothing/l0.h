#pragma once

#include "burnish/base/schema.h"
#include "burnish/smoothing/smoothing.h"

namespace burnish {

struct L0Params {
  double lambda = 0.2;  ///< of (mean edge length)^2 times the mean dihedral angle
  double alpha = 0.1;   ///< of the mean dihedral angle: how even triangles are kept at first
  BoundaryRule boundary = BoundaryRule::fixed;

  static const Schema<L0Params>& schema();
};

/// Flattens noisy facets and keeps the edges between them (He and Schaefer 2013): minimises
///     |p - p*|^2 + lambda #{e: D(e) p != 0} + alpha sum |R(e) p|^2
/// over the edges e with two triangles, where p* are the positions before and D(e) p, their
/// area-based edge operator, is how far the two triangles are from one plane. With e from p1 to p3,
/// triangles 1 2 3 and 1 3 4 of areas A and B:
///     D(e) p = [(A <p4 - p3, p3 - p1> + B <p1 - p3, p3 - p2>) p1
///              + (A <p3 - p1, p1 - p4> + B <p2 - p1, p1 - p3>) p3] / (|e|^2 (A + B))
///              + (B p2 + A p4) / (A + B),           R(e) p = p1 - p2 + p3 - p4
/// As in the paper, d(e) takes the place of D(e) p, at the price beta |D(e) p - d(e)|^2, and beta
/// grows from 1e-3 to 1e3 by sqrt(2): each time d(e) is set to D(e) p, or to 0 where |D(e) p|^2 <=
/// lambda / beta, the quadratic problem in p is solved, D is computed anew, and alpha halved.
///
/// lambda and alpha are relative to the mean edge length l and the mean dihedral angle g of the
/// mesh (radians between normals): lambda l^2 g and alpha g. The paper's 0.02 leaves much of the
/// noise on closed meshes, hence the default.
///
/// For facetted shapes: curved parts become staircases, and noise of half an edge and more is
/// beyond it. boundary: fixed vertices are not unknowns; free boundaries follow the edges inside;
/// along_boundary also counts, among the D, how far each boundary vertex is from the line between
/// its two boundary neighbours. A smoothing weight of w gives that share of the whole
/// move; 0 makes the vertex no unknown, and what is around it adapts. Edges whose triangles have no
/// area, or with coefficients above 1000, are left out. Normals that are there are computed anew,
/// all else stays, also sigma: what is averaged depends on what is found to be flat, and to claim
/// nothing of that is on the safe side.
///
/// 40 sparse Cholesky decompositions, each O(#V^1.5) for usual meshes, on one thread (some
/// seconds for 10,000 vertices); cancellation is looked for in between. Errors: invalid_argument,
/// bad_geometry, cancelled; `mesh` is then unchanged.
Result<SmoothingReport> smooth_l0(TriangleMesh& mesh, const L0Params& params = {},
                                  const Context& context = {});

}  // namespace burnish
