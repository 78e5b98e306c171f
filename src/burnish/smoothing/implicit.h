#pragma once

#include "burnish/base/schema.h"
#include "burnish/smoothing/smoothing.h"

namespace burnish {

/// What becomes of the volume of closed parts.
enum class VolumePolicy {
  kept,  ///< they are scaled to the volume that they had
  free,  ///< they shrink
};

struct ImplicitParams {
  double lambda = 1;  ///< the time of one step, in squares of the mean edge length
  int iterations = 1;
  VolumePolicy volume = VolumePolicy::kept;
  BoundaryRule boundary = BoundaryRule::fixed;

  static const Schema<ImplicitParams>& schema();
};

/// Implicit fairing (Desbrun, Meyer, Schroeder and Barr 1999, sections 2.3 and 5): the surface
/// flows along its curvature normal, in backward Euler steps, which are stable at any length:
///     (M + t S) p' = M p,   t = lambda (mean edge length)^2
/// with S the cotangent stiffness (of an edge: (cot a + cot b) / 2) and M a third of the areas of
/// the triangles at each vertex, both from the positions before the step. Edges that are not
/// Delaunay, whose cotangents add to less than 0, count as 0, which keeps every vertex within the
/// hull of the mesh; angles below 1e-3 rad count as that, and areas below 1e-9 (mean edge)^2 too.
///
/// volume = kept scales every closed and oriented part of the mesh, after each step, about the mean
/// of its vertices to the volume that it had (section 3.4 there); parts in which a vertex is held
/// back are not scaled. Open parts always shrink. Leaves the shapes of triangles nearly as they
/// are; blurs features.
///
/// boundary: fixed vertices are Dirichlet conditions; along_boundary first lets the boundary flow
/// as a curve (one-dimensional stiffness 1 / length), then the rest; free has natural conditions,
/// under which boundaries creep inwards. A smoothing weight of w divides the vertex's mass: it
/// flows at the w-th part of the speed; 0 is a Dirichlet condition. Normals that are there are
/// computed anew, all else stays, also sigma: the step averages, with weights that depend on t and
/// the mesh, and to claim nothing of that is on the safe side.
///
/// One sparse Cholesky decomposition for each iteration, O(#V^1.5) for usual meshes, on one thread.
/// Cancellation is looked for between its steps. Errors: invalid_argument, bad_geometry, cancelled;
/// `mesh` is then unchanged.
Result<SmoothingReport> smooth_implicit(TriangleMesh& mesh, const ImplicitParams& params = {},
                                        const Context& context = {});

}  // namespace burnish
