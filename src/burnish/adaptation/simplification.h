#pragma once

#include <optional>

#include "burnish/base/context.h"
#include "burnish/base/facts.h"
#include "burnish/base/schema.h"
#include "burnish/core/triangle_mesh.h"

// What all simplifications share. They collapse edges, cheapest first, until the mesh is as small
// as it should be, and never so that a triangle turns over, an edge gets a third triangle, or the
// Euler number, a boundary or the orientation changes. Where the mesh is no surface (edges of three
// triangles, vertices where several fans meet, triangles that name a vertex twice) it stays as it
// is. The order of the vertices and triangles that are left is kept.
namespace burnish {

/// How small a mesh should become. With nothing set: half as many triangles.
struct SimplifyParams {
  int target_triangles = 0;  ///< 0: no such target
  double ratio = 0;          ///< of triangles to keep; 0: no such target
  double max_error = 0;      ///< m, both ways between the surfaces; 0: no such bound
  double max_sigmas = 0;     ///< the same in units of the vertices' own sigma; 0: no such bound

  static const Schema<SimplifyParams>& schema();
};

/// What a simplification did.
struct SimplifyReport {
  std::size_t triangles_before = 0, triangles = 0;
  std::size_t removed_vertices = 0;
  bool target_reached = true;  ///< false: what is left cannot go without harm, or by its bound
  std::optional<double> error_bound;  ///< how far the surfaces may be from each other, m, where
                                      ///< that was to be bounded

  Facts facts() const;
};

/// Where the vertex lies that the two ends of a collapsed edge become.
enum class Placement {
  endpoint,  ///< at the better of the two: vertices are removed, none is moved
  optimal,   ///< nearest to the planes around them, with the volume under the surface kept
};

/// Simplifies by collapses of this kind. Errors: invalid_argument; bad_geometry, also where sigma
/// is needed and the mesh has none; cancelled; `mesh` is then unchanged.
Result<SimplifyReport> simplify(TriangleMesh& mesh, Placement placement,
                                const SimplifyParams& params, const Context& context);

}  // namespace burnish
