#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace burnish {

/// The nearest points of every point, itself among them, equally many for all.
class NeighbourLists {
 public:
  NeighbourLists() = default;
  /// `indices` holds `count` neighbours of each point, one point after the other.
  NeighbourLists(std::size_t count, std::vector<std::uint32_t> indices)
      : count_(count), indices_(std::move(indices)) {}

  std::span<const std::uint32_t> of(std::size_t point) const {
    return {indices_.data() + point * count_, count_};
  }
  std::size_t count() const { return count_; }

 private:
  std::size_t count_ = 0;
  std::vector<std::uint32_t> indices_;
};

}  // namespace burnish
