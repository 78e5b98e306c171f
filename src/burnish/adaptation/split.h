#pragma once

#include "burnish/adaptation/refinement.h"
#include "burnish/base/schema.h"

namespace burnish {

struct SplitParams {
  double target_edge_length = 0;  ///< m; 0: none, or the mean where max_chord is 0 too
  double max_chord = 0;           ///< m; 0: none

  static const Schema<SplitParams>& schema();
};

/// Edges that are too long, or along which the surface bends too much, are split in their middle,
/// with the triangles along them, the longest first, until there are none. An edge is too long
/// above target_edge_length: by default above the mean of the mesh as it comes in. It bends too
/// much where the arc between its ends rises by more than max_chord above it. With d from end to
/// end and the ends' normals m and n, s = m + n, the arc rises by (d n - d m) / (4 + 2 |s|) along
/// s, but at most by an eighth of the edge: that is a circle's arc where the normals are a
/// circle's. Normals are the mesh's own, and those of its triangles where it has none or zero ones.
///
/// No triangle is split but across its longest edge (Rivara 1997): where an edge to be split is not
/// that of a triangle along it, the longer one is split first. So no angle gets smaller than half
/// of the smallest before, if the surface is not moved.
///
/// Without max_chord nothing moves: the surface is the same set of points, up to the rounding of
/// the middles to floats. With it new vertices lie on the arcs, so that a coarse mesh of a round
/// thing gets rounder, and so do the edges of a box, whose vertices' normals know no better.
///
/// Where a channel `refinement` confines the method, edges with an end that has 1 are split; others
/// only where they are in the way, at their middle. A closed surface of two triangles with the same
/// three corners stays, however long its edges: it would become non-manifold. Triangles that name a
/// vertex twice are split where their edge is. Euler number, orientation and manifoldness are kept.
/// O(n log n) for n triangles in the end. Errors: invalid_argument (also where more triangles would
/// come of it than can be numbered), bad_geometry, cancelled; `mesh` is then unchanged.
Result<RefinementReport> refine_split(TriangleMesh& mesh, const SplitParams& params = {},
                                      const Context& context = {});

}  // namespace burnish
