#pragma once

#include "burnish/base/schema.h"
#include "burnish/smoothing/smoothing.h"

namespace burnish {

/// Which positions a vertex is moved with.
enum class UpdateOrder {
  jacobi,    ///< all from the positions before the pass
  in_place,  ///< in the order of the vertices, each seeing the new positions of those before it
};

struct NearestFarthestParams {
  int iterations = 1;
  double damping = 0;  ///< 0: the full move; 0.5: half of it
  BoundaryRule boundary = BoundaryRule::fixed;
  UpdateOrder order = UpdateOrder::jacobi;

  static const Schema<NearestFarthestParams>& schema();
};

/// Each vertex moves to the mean of its one-ring in which the nearest and the farthest neighbour
/// count twice (Ozbay and Cinar, Eq. 1):
///     p' = (sum of the n neighbours p_j + p_nearest + p_farthest) / (n + 2)
/// n counts the distinct neighbours, the vertex itself left out. Positions stay in double between
/// the passes.
///
/// Ties: where several neighbours are equally near (far), the mean of them stands for p_nearest
/// (p_farthest). Equally near are distances that differ by at most 1e-9 of themselves. In a ring
/// that is symmetric about its vertex (every neighbour has one opposite to it, |p_j + p_k - 2 p| <=
/// 1e-6 of the mesh's largest coordinate, some roundings to float) opposite neighbours are equally
/// near too. The first makes exact ties independent of the order of vertices; the second keeps the
/// interior of every regular grid where it is, although rounding has made one neighbour the
/// nearest. Elsewhere the equation is followed to the letter: a greater tolerance for all would
/// change ordinary meshes (the Bunny has 38 vertices where the first two places differ by less than
/// float rounding).
///
/// With order = in_place it is the pseudo-code as printed: nearest and farthest are found first for
/// all vertices, then positions are overwritten one after the other, so that the result depends on
/// their order. One thread.
///
/// What to expect: it shrinks (about 18 % more than the plain mean with the vertex itself), blurs
/// features, and is not continuous: a slight change of positions may exchange who is nearest. In a
/// trial on 72 cases it was never better on triangle quality than that mean (smooth_one_ring_mean).
///
/// Normals that are there are computed anew, sigma follows, all else stays. O(iterations * #T).
/// Errors: invalid_argument, bad_geometry, cancelled; `mesh` is then unchanged.
Result<SmoothingReport> smooth_nearest_farthest(TriangleMesh& mesh,
                                                const NearestFarthestParams& params = {},
                                                const Context& context = {});

}  // namespace burnish
