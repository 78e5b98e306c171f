#pragma once

#include "burnish/adaptation/simplification.h"

namespace burnish {

/// Collapses edges, cheapest by the quadric error metric first (Garland and Heckbert 1997), each to
/// the point that is nearest to the planes of the triangles around it and keeps the volume under
/// the surface (Lindstrom and Turk 1998, section 4). Vertices on boundaries
/// stay in their places or go. What is known of vertices is merged with them. O(#T log #T), below
/// 300 bytes a triangle.
/// Errors: invalid_argument, bad_geometry, cancelled; `mesh` is then unchanged.
Result<SimplifyReport> simplify_quadric(TriangleMesh& mesh, const SimplifyParams& params = {},
                                        const Context& context = {});

}  // namespace burnish
