#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/vec3.h"
#include "burnish/spatial/neighbour_grid.h"

namespace burnish {

/// The normal of each point: the direction in which its neighbours vary least, 0 where they span no
/// plane. Where they lie along a line, as on a scan whose lines are far apart, the plane is that of
/// the line and of the nearest points beside it, among 96.
/// Normals look towards `viewpoint` (in the frame of the positions), or without one are oriented
/// consistently (orientation.h), component by component, whose number is then given too. `grid`
/// and `neighbours` are of `positions`. Returns false where cancelled. O(#P k).
[[nodiscard]] bool normals_of_surface(std::span<const Vec3f> positions, const NeighbourGrid& grid,
                                      const NeighbourLists& neighbours,
                                      const std::optional<Vec3d>& viewpoint, const Context& context,
                                      std::vector<Vec3f>& normals, std::size_t& components);

}  // namespace burnish
