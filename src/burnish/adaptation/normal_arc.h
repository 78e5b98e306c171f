#pragma once

#include <algorithm>

#include "burnish/base/vec3.h"

namespace burnish {

/// The middle of the arc that a surface follows between two of its points, as their normals say: of
/// a circle's where they are those of one.
struct NormalArc {
  Vec3d rise;    ///< from the middle of the straight edge, m; at most an eighth of its length
  Vec3d normal;  ///< there, of unit length (Vlachos et al. 2001, quadratically varying normals)

  /// `along` leads from the first point to the second; normals are of unit length, or 0. Where they
  /// are opposite the result is straight, without a normal.
  NormalArc(const Vec3d& along, const Vec3d& first, const Vec3d& second) {
    const Vec3d sum = first + second;
    const double length = norm(along), sum_length = norm(sum);
    if (length == 0 || sum_length == 0) {
      normal = normalized(sum);
      return;
    }
    // Of an arc of angle 2 phi: the dot products are length * sin(phi) on either side of 0, the sum
    // of the normals is 2 cos(phi) long, and the rise is length / 2 * tan(phi / 2).
    const double height = (dot(along, second) - dot(along, first)) / (4 + 2 * sum_length);
    rise = sum * (std::clamp(height, -length / 8, length / 8) / sum_length);
    normal = normalized(sum - along * (2 * dot(along, sum) / (length * length)));
  }
};

}  // namespace burnish
