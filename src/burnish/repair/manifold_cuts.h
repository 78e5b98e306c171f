#pragma once

#include "burnish/base/context.h"
#include "burnish/base/facts.h"
#include "burnish/base/schema.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

struct ManifoldParams {
  /// Where more than two triangles meet in an edge, those with matter between them stay joined;
  /// false: none does.
  bool keep_solids = true;

  static const Schema<ManifoldParams>& schema();
};

/// What was taken away and cut.
struct ManifoldReport {
  std::size_t degenerate_triangles = 0;  ///< removed: named a vertex twice
  std::size_t duplicate_triangles = 0;   ///< removed: had the same vertices as others
  std::size_t singular_edges = 0;        ///< in which more than two triangles met
  std::size_t flipped_edges = 0;         ///< cut: their two triangles disagreed on the orientation
  std::size_t added_vertices = 0;        ///< copies, where triangles are no longer joined

  Facts facts() const;
};

/// Makes a mesh an oriented manifold. Triangles that name a vertex twice go. Of those with the same
/// vertices the first stays that runs as most of them do, and none where as many run either way:
/// they are two sheets with nothing between. Then the surface is cut along edges in which more than
/// two triangles meet, or two that disagree on the orientation, and at vertices where several fans
/// touch (Gueziec, Taubin, Lazarus and Horn 2001, section 3, by the corners of the triangles). No
/// triangle moves. Solids that touch in an edge come apart closed; where triangles around an edge
/// do not alternate between outside and matter, all are cut there. Old vertices keep their numbers,
/// copies follow with the same attributes; a fan's owner is the first of its copies. A mesh that is
/// an oriented manifold is left as it is. O(#V + #T log #T).
/// Errors: invalid_argument, bad_geometry, cancelled; `mesh` is then unchanged.
Result<ManifoldReport> make_manifold(TriangleMesh& mesh, const ManifoldParams& params = {},
                                     const Context& context = {});

}  // namespace burnish
