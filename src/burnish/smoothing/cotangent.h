#pragma once

#include <algorithm>
#include <cmath>

#include "burnish/base/vec3.h"

namespace burnish {

/// The cotangent of the angle at `a` of the triangle a, b, c. An angle nearer to 0 or pi than a
/// thousandth of a radian counts as if it were that far off: slivers have a finite weight, and one
/// that does not jump where rounding makes a sliver flat. 0 where `a` lies on `b` or `c`.
inline double cotangent(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  constexpr double kLeastAngle = 1e-3;
  const Vec3d u = b - a, v = c - a;
  const double cosine = dot(u, v);
  const double sine = std::max(norm(cross(u, v)), kLeastAngle * std::abs(cosine));
  return sine > 0 ? cosine / sine : 0;
}

}  // namespace burnish
