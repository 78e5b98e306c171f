#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/vec3.h"

namespace burnish {

/// Turns normals so that they agree along a minimum spanning tree of the neighbours (Hoppe et al.
/// 1992, section 3.3), with weights 1 - |cos| between a normal and the neighbour's mirror image in
/// the plane between the two points, ties by index. In each component the point of
/// largest z (then of smallest index) looks towards +z. `neighbours` holds `count` indices a point,
/// itself and padding by itself allowed; points whose normal is 0 take no part. Returns the number
/// of components; where the context is cancelled, anything. O(#P k log #P).
std::size_t orient_consistently(std::span<const Vec3f> positions,
                                std::span<const std::uint32_t> neighbours, std::size_t count,
                                std::vector<Vec3f>& normals, const Context& context);

}  // namespace burnish
