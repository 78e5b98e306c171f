#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace burnish {

/// Finds which of many timestamps, in any order, is nearest to a given one.
class NearestTime {
 public:
  /// `times` must be finite. O(n log n).
  explicit NearestTime(std::vector<double> times);

  /// The index of the timestamp nearest to `time`, none where it is farther than `window`. Of two
  /// equally near the earlier, of equal ones the last. O(log n).
  std::optional<std::size_t> find(double time, double window) const;

 private:
  std::vector<double> times_;
  std::vector<std::size_t> order_;  ///< of times_, the earliest first
};

}  // namespace burnish
