#pragma once

#include <span>

#include "burnish/base/vec3.h"

namespace burnish {

/// Where points are and how they spread.
struct PointMoments {
  std::size_t count = 0;  ///< of finite points
  Vec3d mean{};
  Vec3d least_direction{1, 0, 0};  ///< the plane of least squares has this normal; length 1, z >= 0
};

/// Of the finite ones of `points`, to 2^-30 of their box's longest side. Sums are of whole numbers,
/// so that not a bit depends on the order of the points. At most 2^32 points. O(#points).
PointMoments moments(std::span<const Vec3f> points);

}  // namespace burnish
