#pragma once

#include <cstddef>

#include "burnish/base/context.h"
#include "burnish/triangulation/manifold_surface.h"

namespace burnish {

/// Closes boundary loops of at most `max_edges` edges by the triangulation of best shape (the least
/// sum of squared edges / area over its triangles, by dynamic programming; Barequet and Sharir
/// 1995), as far as it faces along the normals and the surface stays manifold. Adds the number of
/// triangles to `added`. Returns false where cancelled. O(#V + #loops * max_edges^3).
[[nodiscard]] bool close_small_holes(ManifoldSurface& surface, std::span<const Vec3f> positions,
                                     std::span<const Vec3f> normals, std::size_t max_edges,
                                     const Context& context, std::size_t& added);

}  // namespace burnish
