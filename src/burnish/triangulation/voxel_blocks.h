#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "burnish/base/vec3.h"

namespace burnish {

/// Where a block lies, in blocks.
struct BlockPlace {
  std::int32_t x = 0, y = 0, z = 0;
  friend bool operator==(const BlockPlace&, const BlockPlace&) = default;
};

/// Whether `a` comes before `b` in the order in which blocks are gone through: z, then y, then x.
bool operator<(const BlockPlace& a, const BlockPlace& b);

/// 8 x 8 x 8 voxels and what was measured of them: sums of integers, which come out the same
/// whatever the order of what was added. Voxel (x, y, z) is number (z * 8 + y) * 8 + x.
struct VoxelBlock {
  static constexpr int kSide = 8;
  static constexpr std::size_t kVoxels = kSide * kSide * kSide;

  /// The first voxel of the block there, in voxels from the world's origin.
  static Vec3d lowest(const BlockPlace& place) {
    return Vec3d(Vec3<std::int32_t>{place.x, place.y, place.z}) * double{kSide};
  }

  /// Upper 48 bits: the sum of weight * distance; lower 16: the number of frames that measured it.
  std::array<std::int64_t, kVoxels> sums{};
  std::array<std::uint32_t, kVoxels> weights{};
  std::array<std::uint16_t, kVoxels> seen_free{};  ///< the number of frames that saw it empty
};

/// The blocks of a sparse volume, found by their place: a hash table with open addressing (linear
/// probing) of indices into blocks that never move. Nothing depends on the order in which blocks
/// came but their indices. Finding is safe from many threads at once.
class VoxelBlocks {
 public:
  static constexpr std::uint32_t kNone = 0xffffffff;

  VoxelBlocks();

  std::size_t size() const { return places_.size(); }
  std::span<const BlockPlace> places() const { return places_; }
  VoxelBlock& operator[](std::size_t i) { return chunks_[i / kChunk][i % kChunk]; }
  const VoxelBlock& operator[](std::size_t i) const { return chunks_[i / kChunk][i % kChunk]; }

  /// The index of the block there, kNone where there is none.
  std::uint32_t find(const BlockPlace& place) const;
  /// The same; makes an empty block where there is none. Throws std::bad_alloc.
  std::uint32_t find_or_add(const BlockPlace& place);

  /// The indices of all blocks in the order of their places.
  std::vector<std::uint32_t> in_order() const;

 private:
  static constexpr std::size_t kChunk = 64;

  std::size_t slot_of(const BlockPlace& place) const;
  void grow();

  std::vector<std::uint32_t> slots_;  ///< a power of two of them; kNone: empty
  std::vector<BlockPlace> places_;
  std::vector<std::unique_ptr<VoxelBlock[]>> chunks_;
};

}  // namespace burnish
