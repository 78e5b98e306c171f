#pragma once

#include <vector>

#include "burnish/adaptation/removal.h"
#include "burnish/adaptation/simplification.h"
#include "burnish/base/context.h"
#include "burnish/base/result.h"

namespace burnish {

/// Removes vertices and moves none: half-edge collapses, in rounds of the cheapest by the quadric
/// error metric (Garland and Heckbert 1997). What is known of the vertices left stays as it was.
/// O(#T log #T), below 300 bytes a triangle.
/// Errors: invalid_argument, bad_geometry, cancelled; `mesh` is then unchanged.
Result<SimplifyReport> simplify_point_removal(TriangleMesh& mesh, const SimplifyParams& params = {},
                                              const Context& context = {});

/// The same removals for whoever wants to make and undo them, in order, each with the bound of the
/// error after it: down to `target` triangles, or as far as it goes. Errors as above.
Result<std::vector<Removal>> removal_log(const TriangleMesh& mesh, std::size_t target = 0,
                                         const Context& context = {});

}  // namespace burnish
