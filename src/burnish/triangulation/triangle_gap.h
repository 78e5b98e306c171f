#pragma once

#include <algorithm>
#include <cmath>

#include "burnish/base/vec3.h"

namespace burnish {

/// The gap that a triangle spans between the points of a sampling: how far the point of it is from
/// its nearest corner that is farthest from all three, m. The circumscribed circle's radius for an
/// acute triangle; less for an obtuse one, whose bisectors meet outside it.
inline double triangle_gap(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  double least = squared_norm(c - b), middle = squared_norm(a - c), most = squared_norm(b - a);
  if (least > middle) std::swap(least, middle);
  if (middle > most) std::swap(middle, most);
  if (least > middle) std::swap(least, middle);
  if (most < least + middle) {
    return std::sqrt(least * middle * most / squared_norm(cross(b - a, c - a))) / 2;
  }
  // The bisector of the middle edge meets the longest there.
  return std::sqrt(most) * middle / (most + middle - least);
}

}  // namespace burnish
