#pragma once

#include <span>

#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// A right-handed orthonormal frame.
struct StarFrame {
  Vec3d u{1, 0, 0}, v{0, 1, 0}, normal{0, 0, 1};

  Vec3d into(const Vec3d& d) const { return {dot(u, d), dot(v, d), dot(normal, d)}; }
  Vec3d out_of(const Vec3d& d) const { return u * d.x + v * d.y + normal * d.z; }
};

/// A frame that moves with some triangles around the vertex `apex`: its normal is their mean by
/// area, `u` points towards the corner after `apex` of the middle one, as far as that is across the
/// normal. The axes of space where rounding would decide on one of the two.
inline StarFrame star_frame(std::span<const Vec3f> positions, std::span<const Triangle> triangles,
                            std::span<const std::uint32_t> star, std::uint32_t apex) {
  constexpr double kRounding = 1e-10;  // of sums of products of floats, in double, with room
  const auto at = [&](std::uint32_t vertex) { return Vec3d(positions[vertex]); };
  Vec3d area{};
  double size = 0;
  for (const std::uint32_t t : star) {
    const auto [a, b, c] = triangles[t];
    const Vec3d side = at(b) - at(a), other = at(c) - at(a);
    area += cross(side, other);
    size += squared_norm(side) + squared_norm(other);
  }
  if (norm(area) <= kRounding * size) return {};
  const Vec3d normal = normalized(area);

  const Triangle& middle = triangles[star[star.size() / 2]];
  const std::size_t corner = middle[0] == apex ? 0 : middle[1] == apex ? 1 : 2;
  const Vec3d along = at(middle[(corner + 1) % 3]) - at(apex);
  const Vec3d across = along - normal * dot(along, normal);
  if (squared_norm(across) <= kRounding * size) return {};
  const Vec3d u = normalized(across);
  return {u, cross(normal, u), normal};
}

}  // namespace burnish
