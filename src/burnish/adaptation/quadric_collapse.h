#pragma once

#include "burnish/adaptation/simplification.h"

namespace burnish {

/// Collapses edges, each to the point that is nearest to the planes of all triangles that it stands
/// for, cheapest first (quadric error metric: Garland and Heckbert 1997). Vertices on boundaries
/// stay in their places or go. What is known of vertices is merged with them. O(#T log #T), below
/// 300 bytes a triangle.
/// Errors: invalid_argument, bad_geometry, cancelled; `mesh` is then unchanged.
Result<SimplifyReport> simplify_quadric(TriangleMesh& mesh, const SimplifyParams& params = {},
                                        const Context& context = {});

}  // namespace burnish
