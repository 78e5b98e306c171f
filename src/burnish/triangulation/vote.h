#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/core/triangle_mesh.h"
#include "burnish/triangulation/local_fans.h"

namespace burnish {

/// A triangle that some fans propose; its smallest index first, counter-clockwise around the
/// normals.
struct Candidate {
  Triangle triangle;
  std::uint8_t votes;  ///< of how many of its three corners' fans it is part
  float shape;         ///< 4 sqrt(3) area / sum of squared edges: 1 equilateral, 0 degenerate
};

/// Every triangle of the fans once, in the order of the fans, save those that span a gap (whose
/// circumscribed circle is wider than `reach` times the largest spacing of their corners) and those
/// that face away from the normal of a corner. Returns false where cancelled. O(#fan triangles).
bool count_votes(std::span<const Vec3f> positions, std::span<const Vec3f> normals, const Fans& fans,
                 double reach, const Context& context, std::vector<Candidate>& candidates);

}  // namespace burnish
