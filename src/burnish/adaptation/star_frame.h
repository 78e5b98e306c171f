#pragma once

#include <span>

#include "burnish/base/tangent_frame.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// A right-handed frame that moves with some triangles around the vertex `apex`: its normal is
/// their mean by area, `u` points towards the corner after `apex` of the middle one, as far as that
/// is across the normal. Where they have no area the frame is of no meaning, but orthonormal.
inline TangentFrame star_frame(std::span<const Vec3f> positions,
                               std::span<const Triangle> all_triangles,
                               std::span<const std::uint32_t> star, std::uint32_t apex) {
  const auto at = [&](std::uint32_t v) { return Vec3d(positions[v]); };
  Vec3d area{};
  for (const std::uint32_t t : star) {
    const auto [a, b, c] = all_triangles[t];
    area += cross(at(b) - at(a), at(c) - at(a));
  }
  const Vec3d normal = normalized(area);
  TangentFrame frame(normal == Vec3d{} ? Vec3d{0, 0, 1} : normal);
  const Triangle& middle = all_triangles[star[star.size() / 2]];
  const std::uint32_t towards = middle[0] == apex   ? middle[1]
                                : middle[1] == apex ? middle[2]
                                                    : middle[0];
  const Vec3d along = at(towards) - at(apex);
  const Vec3d across = along - frame.normal * dot(along, frame.normal);
  // What rounding left of it would not be across.
  if (squared_norm(across) <= 1e-12 * squared_norm(along)) return frame;
  frame.u = normalized(across);
  frame.v = cross(frame.normal, frame.u);
  return frame;
}

inline Vec3d into_frame(const TangentFrame& frame, const Vec3d& d) {
  return {dot(frame.u, d), dot(frame.v, d), dot(frame.normal, d)};
}

inline Vec3d out_of_frame(const TangentFrame& frame, const Vec3d& d) {
  return frame.u * d.x + frame.v * d.y + frame.normal * d.z;
}

}  // namespace burnish
