#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "burnish/spatial/neighbour_grid.h"

namespace burnish {

/// The nearest of the points that are offered, sorted by (distance, index), in a vector that is
/// emptied first. An offer costs O(count) at most.
class NearestList {
 public:
  NearestList(std::size_t count, std::vector<Neighbour>& found) : count_(count), found_(found) {
    found_.clear();
  }

  /// Points farther away are not wanted.
  double squared_radius() const { return squared_radius_; }

  /// Returns whether the point was taken.
  bool offer(const Neighbour& point) {
    if (point.squared_distance > squared_radius_) return false;
    if (found_.size() < count_) {
      found_.push_back(point);
    } else if (found_.empty() || !nearer(point, found_.back())) {
      return false;
    }
    std::size_t place = found_.size() - 1;
    for (; place > 0 && nearer(point, found_[place - 1]); --place) {
      found_[place] = found_[place - 1];
    }
    found_[place] = point;
    if (found_.size() == count_) squared_radius_ = found_.back().squared_distance;
    return true;
  }

 private:
  static bool nearer(const Neighbour& a, const Neighbour& b) {
    return a.squared_distance != b.squared_distance ? a.squared_distance < b.squared_distance
                                                    : a.index < b.index;
  }

  std::size_t count_;
  std::vector<Neighbour>& found_;
  double squared_radius_ = std::numeric_limits<double>::infinity();
};

}  // namespace burnish
