#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "burnish/base/vec3.h"

namespace burnish {

/// The finite ones of `points`, one of each position (the first), along a space-filling curve
/// (Morton 1966): an order that depends on the positions alone and keeps neighbours close in
/// memory. O(#P log #P).
std::vector<std::uint32_t> order_along_curve(std::span<const Vec3f> points);

}  // namespace burnish
