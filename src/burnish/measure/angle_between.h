#pragma once

#include <cmath>

#include "burnish/base/vec3.h"

namespace burnish {

/// The angle between two directions of any length, 0 to pi, rad; accurate near both ends, where the
/// arc cosine is not. 0 where one of them is the zero vector.
inline double angle_between(const Vec3d& a, const Vec3d& b) {
  return std::atan2(norm(cross(a, b)), dot(a, b));
}

}  // namespace burnish
