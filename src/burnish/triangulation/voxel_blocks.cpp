#include "burnish/triangulation/voxel_blocks.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace burnish {

bool operator<(const BlockPlace& a, const BlockPlace& b) {
  return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x);
}

VoxelBlocks::VoxelBlocks() : slots_(1024, kNone) {}

/// The slot that holds the place, or the empty one where it would go.
std::size_t VoxelBlocks::slot_of(const BlockPlace& place) const {
  // Finalizer of splitmix64 (Steele, Lea and Flood 2014) over the three coordinates.
  std::uint64_t hash = static_cast<std::uint32_t>(place.x);
  hash |= std::uint64_t{static_cast<std::uint32_t>(place.y)} << 32;
  hash += static_cast<std::uint32_t>(place.z) * 0x9e3779b97f4a7c15u;
  hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9u;
  hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebu;
  std::size_t slot = (hash ^ (hash >> 31)) & (slots_.size() - 1);
  while (slots_[slot] != kNone && !(places_[slots_[slot]] == place)) {
    slot = (slot + 1) & (slots_.size() - 1);
  }
  return slot;
}

std::uint32_t VoxelBlocks::find(const BlockPlace& place) const {
  return slots_[slot_of(place)];
}

std::uint32_t VoxelBlocks::find_or_add(const BlockPlace& place) {
  std::size_t slot = slot_of(place);
  if (slots_[slot] != kNone) return slots_[slot];
  if (2 * (size() + 1) > slots_.size()) {
    grow();
    slot = slot_of(place);
  }
  if (size() == chunks_.size() * kChunk) chunks_.push_back(std::make_unique<VoxelBlock[]>(kChunk));
  const auto index = static_cast<std::uint32_t>(size());
  places_.push_back(place);
  slots_[slot] = index;
  return index;
}

void VoxelBlocks::grow() {
  slots_ = std::vector<std::uint32_t>(2 * slots_.size(), kNone);
  for (std::uint32_t i = 0; i < places_.size(); ++i) slots_[slot_of(places_[i])] = i;
}

std::vector<std::uint32_t> VoxelBlocks::in_order() const {
  std::vector<std::uint32_t> order(size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [this](std::uint32_t a, std::uint32_t b) { return places_[a] < places_[b]; });
  return order;
}

}  // namespace burnish
