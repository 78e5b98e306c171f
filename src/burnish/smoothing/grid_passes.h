#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/core/grid_rings.h"
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
  void prepare(const GridSize& size);
  void sort_rows(const GridRings& rings, std::span<const std::uint32_t> pixels);

  GridSize size_;
  std::array<std::array<std::int32_t, 8>, 256>
      neighbours_{};                             ///< by mask, their distance in pixels
  std::array<std::uint8_t, 256> counts_{};       ///< by mask, how many they are
  std::array<std::vector<Vec3d>, 2> positions_;  ///< per pixel, before passes that are even and odd
  std::vector<std::size_t> first_;               ///< per row, the first vertex in it
  /// The pixels of each row's vertices, those with as many neighbours side by side: the processor
  /// can then foretell how long the next ring is.
  std::vector<std::uint32_t> sorted_;
  std::vector<std::array<std::uint32_t, 10>> groups_;  ///< per row, where each number begins
};

}  // namespace burnish
