#pragma once

#include <vector>

#include "burnish/base/context.h"
#include "burnish/core/triangle_mesh.h"
#include "burnish/triangulation/fan_cloud.h"

namespace burnish {

/// Every triangle of every fan; its owner first, counter-clockwise around the owner's fan normal.
std::vector<Triangle> all_fan_triangles(const FanCloud& fans);

/// Triangles of the fans, no two with the same corners, that cover the surface around every point
/// as far as its own fan does; where fans agree, each place once. First whole fans, greedily in the
/// order of the points, none of which has another's centre; then what these leave open around the
/// other points. Empty where cancelled. O(#fan triangles).
std::vector<Triangle> covering_fan_triangles(const FanCloud& fans, const Context& context);

}  // namespace burnish
