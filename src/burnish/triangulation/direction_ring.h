#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace burnish {

/// Directions in a plane, sorted by angle, and the gaps between them.
class DirectionRing {
 public:
  struct Direction {
    double angle;  ///< -pi to pi
    std::uint32_t point;
  };

  void clear() { directions_.clear(); }

  /// Returns false, and leaves the ring, where a direction is there already. O(#directions).
  bool insert(const Direction& direction);

  /// The gap in which `angle` lies; 2 pi in an empty ring.
  double gap_at(double angle) const;

  /// The widest of the gaps from direction number `from` counter-clockwise to number `to`; all
  /// around where these are the same. 2 pi in a ring of one.
  double widest_gap(std::size_t from, std::size_t to) const;
  double widest_gap() const;

  std::size_t size() const { return directions_.size(); }
  const Direction& operator[](std::size_t i) const { return directions_[i]; }

 private:
  std::size_t first_after(double angle) const;
  double gap_after(std::size_t i) const;

  std::vector<Direction> directions_;
};

}  // namespace burnish
