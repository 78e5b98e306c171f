#pragma once

#include <cstddef>

#include "burnish/base/context.h"
#include "burnish/triangulation/local_fans.h"
#include "burnish/triangulation/manifold_surface.h"

namespace burnish {

/// How holes are closed.
struct HoleRule {
  std::size_t max_edges = 12;
  double max_gap = 2;  ///< widest gap of a triangle, in the largest spacing of its corners
};

/// Closes boundary loops of at most `max_edges` edges by the triangulation of best shape (the least
/// sum of squared edges / area over its triangles, by dynamic programming; Barequet and Sharir
/// 1995; turning away from normals costs), as far as it is no wider than the sampling says and the
/// surface stays manifold. Loops around islands stay. The triangles are marked as invented. Returns
/// false where cancelled. O(#V + #loops * max_edges^3).
[[nodiscard]] bool close_small_holes(ManifoldSurface& surface, std::span<const Vec3f> positions,
                                     std::span<const Vec3f> normals, const Fans& fans,
                                     const HoleRule& rule, const Context& context);

}  // namespace burnish
