#pragma once

#include <cstdint>
#include <span>

#include "burnish/base/vec3.h"
#include "burnish/spatial/neighbour_grid.h"

namespace burnish {

/// Unit normal of the plane of least squares through a point and some neighbours of it; 0 where no
/// plane fits better than others, because they lie on a line or spread alike in all directions. Of
/// the two directions that whose largest coordinate is positive.
Vec3d least_squares_normal(std::span<const Vec3f> positions, std::uint32_t point,
                           std::span<const Neighbour> neighbours);

}  // namespace burnish
