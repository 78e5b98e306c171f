#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/core/grid_rings.h"
#include "burnish/smoothing/grid_row.h"
#include "burnish/smoothing/nearest_farthest.h"

namespace burnish {

/// smooth_nearest_farthest on a mesh over an image grid, for a camera that runs: neighbours are
/// found by their place in the image, and what is worked with is kept from one image to the next.
class GridPasses {
 public:
  /// Gives `positions` what smooth_nearest_farthest would give the mesh, to the bit.
  ///   rings      of its inner vertices
  ///   pixels     where its vertices are in the image, rising
  ///   positions  its vertices, m
  /// All passes go through the image together, each a row behind the one before, on one thread.
  /// Nothing is allocated where an image of as many pixels was smoothed before. Errors:
  /// invalid_argument (also for other rules than boundary = fixed and order = jacobi), cancelled;
  /// `positions` are then unchanged. O(iterations * #pixels).
  Result<void> smooth(const GridRings& rings, std::span<const std::uint32_t> pixels,
                      const NearestFarthestParams& params, const Context& context,
                      std::span<Vec3f> positions);

 private:
  void prepare(const GridSize& size, std::span<const std::uint32_t> pixels);

  GridSize size_;
  std::array<Planes, 2> planes_;     ///< before passes that are even and odd
  std::vector<std::size_t> first_;   ///< per row, the first vertex in it
  std::vector<std::uint8_t> masks_;  ///< of one row
};

}  // namespace burnish
