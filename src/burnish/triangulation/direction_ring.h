#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace burnish {

/// Directions in a plane, sorted by angle, and the gaps between them.
class DirectionRing {
 public:
  /// From a wider angle on, rad, less than pi, what lies between two directions is a gap.
  explicit DirectionRing(double widest);

  void clear() { directions_.clear(); }

  /// The direction (x, y), not 0, of point number `point`. Left out where a direction is there
  /// already. O(#directions).
  void insert(double x, double y, std::uint32_t point);

  /// Whether (x, y) lies in a gap. An empty ring is one.
  bool in_gap(double x, double y) const;

  /// Whether there is a gap on the way from direction number `from` counter-clockwise to number
  /// `to`; all around where these are the same.
  bool gap_between(std::size_t from, std::size_t to) const;
  bool any_gap() const { return directions_.empty() || gap_between(0, 0); }

  std::size_t size() const { return directions_.size(); }
  std::uint32_t point(std::size_t i) const { return directions_[i].point; }

 private:
  /// Angles as turn_of has them.
  struct Direction {
    double turn, widest;  ///< `widest`: to the next direction without a gap
    std::uint32_t point;
  };
  std::size_t last_before(double turn) const;
  double to_next(std::size_t i) const;

  std::vector<Direction> directions_;
  double cos_, sin_;
};

}  // namespace burnish
