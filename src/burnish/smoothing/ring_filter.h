#pragma once

#include <functional>
#include <span>

#include "burnish/smoothing/smoothing.h"

namespace burnish {

/// Where a vertex goes: `ring` are its neighbours under the boundary rule, never empty.
using RingRule = std::function<Vec3d(std::uint32_t vertex, std::span<const std::uint32_t> ring,
                                     std::span<const Vec3f> positions)>;

/// `iterations` Jacobi passes of `rule` over the one-rings: every new position is computed from the
/// old ones. Vertices without neighbours and, by the boundary rule, fixed ones stay. On error or
/// cancellation `mesh` is unchanged. O(iterations * #T).
Result<SmoothingReport> filter_rings(TriangleMesh& mesh, int iterations, BoundaryRule boundary,
                                     const Context& context, const RingRule& rule);

}  // namespace burnish
