#pragma once

#include <cstdint>
#include <span>

#include "burnish/base/vec3.h"

namespace burnish {

/// How points vary around their mean.
struct Variation {
  Vec3d least;         ///< the direction of unit length in which they vary least; 0: no plane
  double breadth = 0;  ///< second largest variance over the largest
};

/// Points of a narrow strip (one part wide, three long), of less breadth than this, do not tell a
/// plane from a curve.
constexpr double kNarrow = 0.1;

/// Of the points `which`: the normal of their plane of least squares, of either sign. No plane
/// where they are fewer than three, on a line, or alike in all directions. O(#which).
Variation variation(std::span<const Vec3f> positions, std::span<const std::uint32_t> which);

}  // namespace burnish
