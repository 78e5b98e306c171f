#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/vec3.h"
#include "burnish/spatial/neighbour_grid.h"

namespace burnish {

/// The direction of unit length in which the points `which` vary least; 0 where they span no plane.
Vec3d direction_of_least_variance(std::span<const Vec3f> positions,
                                  std::span<const std::uint32_t> which);

/// The normal of each point from its neighbours, 0 where they span no plane: towards `viewpoint`
/// (in the frame of the positions), or without one oriented consistently (orientation.h), component
/// by component, whose number is then given too. Returns false where cancelled. O(#P k).
[[nodiscard]] bool normals_of_surface(std::span<const Vec3f> positions,
                                      const NeighbourLists& neighbours,
                                      const std::optional<Vec3d>& viewpoint, const Context& context,
                                      std::vector<Vec3f>& normals, std::size_t& components);

}  // namespace burnish
