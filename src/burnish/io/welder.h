#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "burnish/base/vec3.h"

namespace burnish {

/// Gives equal points one number, in the order of their first appearance. A hash table with linear
/// probing; at most half full.
class Welder {
 public:
  explicit Welder(std::vector<Vec3f>& points) : points_(points), slots_(64, kEmpty) {}

  std::uint32_t operator()(const Vec3f& point) {
    std::size_t slot = hash(point) & (slots_.size() - 1);
    while (slots_[slot] != kEmpty) {
      if (key(points_[slots_[slot]]) == key(point)) return slots_[slot];
      slot = (slot + 1) & (slots_.size() - 1);
    }
    const auto number = static_cast<std::uint32_t>(points_.size());
    points_.push_back(point);
    slots_[slot] = number;
    if (2 * points_.size() > slots_.size()) grow();
    return number;
  }

 private:
  static constexpr std::uint32_t kEmpty = ~0u;

  /// The bits, so that a NaN equals itself; adding 0 turns -0 into 0.
  static std::array<std::uint32_t, 3> key(const Vec3f& p) {
    return {std::bit_cast<std::uint32_t>(p.x + 0.f), std::bit_cast<std::uint32_t>(p.y + 0.f),
            std::bit_cast<std::uint32_t>(p.z + 0.f)};
  }

  static std::size_t hash(const Vec3f& p) {
    std::uint64_t h = 0;
    for (const std::uint32_t part : key(p)) h = (h ^ part) * 0x9e3779b97f4a7c15u, h ^= h >> 29;
    return static_cast<std::size_t>(h);
  }

  void grow() {
    slots_.assign(2 * slots_.size(), kEmpty);
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      std::size_t slot = hash(points_[i]) & (slots_.size() - 1);
      while (slots_[slot] != kEmpty) slot = (slot + 1) & (slots_.size() - 1);
      slots_[slot] = i;
    }
  }

  std::vector<Vec3f>& points_;
  std::vector<std::uint32_t> slots_;
};

}  // namespace burnish
