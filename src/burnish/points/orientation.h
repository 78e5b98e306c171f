#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/vec3.h"
#include "burnish/spatial/neighbour_grid.h"

namespace burnish {

/// Turns normals so that they agree along a minimum spanning tree of the neighbours (Hoppe et al.
/// 1992, section 3.3), with weights 1 - |cos| between a normal and the neighbour's mirror image in
/// the plane between the two points; weights below 1/16 count as equal, the links to the nearest
/// neighbours first. What is then apart from the largest component looks for a light link among its
/// 96 nearest points. In each component the points farthest out along the six axes look outwards;
/// where these contradict each other, as on an open surface, that of largest z looks up. Points
/// whose normal is 0 take no part. Returns the number of components; where the context is cancelled,
/// anything. O(#P k).
std::size_t orient_consistently(std::span<const Vec3f> positions, const NeighbourGrid& grid,
                                const NeighbourLists& neighbours, std::vector<Vec3f>& normals,
                                const Context& context);

}  // namespace burnish
