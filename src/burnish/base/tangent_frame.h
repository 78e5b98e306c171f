#pragma once

#include <cmath>

#include "burnish/base/vec3.h"

namespace burnish {

/// A right-handed frame: the plane of `u` and `v` is perpendicular to the unit vector `normal`
/// (Duff et al. 2017).
struct TangentFrame {
  Vec3d u, v, normal;

  TangentFrame() = default;
  explicit TangentFrame(const Vec3d& n) : normal(n) {
    const double sign = std::copysign(1.0, n.z);
    const double a = -1 / (sign + n.z), b = n.x * n.y * a;
    u = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    v = {b, sign + n.y * n.y * a, -n.y};
  }
};

}  // namespace burnish
