#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "burnish/base/vec3.h"

namespace burnish {

/// From positions[v] to the mean of its neighbours, each weighted by its distance:
/// sum |e_j| e_j / sum |e_j| with e_j = p_j - p. What Eq. 1 does to the nearest and the farthest
/// neighbour alone, continuously. 0 where there are no neighbours, or all lie on the vertex.
inline Vec3d length_weighted_step(std::span<const Vec3d> positions,
                                  std::span<const std::uint32_t> neighbours, std::size_t v) {
  Vec3d sum;
  double total = 0;
  for (const std::uint32_t w : neighbours) {
    const Vec3d edge = positions[w] - positions[v];
    const double length = norm(edge);
    sum += length * edge;
    total += length;
  }
  return total > 0 ? sum / total : Vec3d{};
}

}  // namespace burnish
