#pragma once

#include "burnish/base/vec3.h"

namespace burnish {

/// The middle of the cubic curve between two points that leaves each at a right angle to the normal
/// there (the edge of a curved PN triangle, Vlachos et al. 2001).
struct NormalCurve {
  Vec3d rise;    ///< from the middle of the straight edge to that of the curve; at most an eighth
                 ///< of the edge's length
  Vec3d normal;  ///< of unit length, at a right angle to the curve; 0 where there is none

  /// `along` leads from the first point to the second; normals are of unit length, or 0.
  NormalCurve(const Vec3d& along, const Vec3d& first, const Vec3d& second) {
    const Vec3d climb = dot(along, first) * first, fall = dot(along, second) * second;
    rise = (fall - climb) / 8.0;
    const Vec3d tangent = 4.0 * along + climb + fall, sum = first + second;
    const double length = squared_norm(tangent);
    normal = normalized(length > 0 ? sum - tangent * (dot(tangent, sum) / length) : sum);
  }
};

}  // namespace burnish
