#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "burnish/core/point_cloud.h"

namespace burnish {

/// The one-rings of a mesh over an image grid: every neighbour of a pixel is one of the eight
/// around it. Bit k of a pixel's mask says whether neighbour k is one; they are counted in the
/// order of the pixels, which is that of the mesh's vertices: above left, above, above right, left,
/// right, below left, below, below right.
struct GridRings {
  GridSize size;
  std::vector<std::uint8_t> inner;  ///< per pixel; 0 where it is no vertex, or on the boundary
};

/// How far the neighbours of a pixel are from it, in pixels of an image `width` wide.
inline std::array<std::int32_t, 8> grid_neighbours(std::uint32_t width) {
  const auto row = static_cast<std::int32_t>(width);
  return {-row - 1, -row, -row + 1, -1, 1, row - 1, row, row + 1};
}

}  // namespace burnish
