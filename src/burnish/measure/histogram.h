#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace burnish {

/// How many values fall into each of equal bins from `low` to `high`. Values beyond the ends are in
/// the first and the last bin.
struct Histogram {
  double low = 0, high = 1;
  std::vector<std::uint64_t> counts;

  double bin_width() const { return (high - low) / static_cast<double>(counts.size()); }
};

/// `bins` must be positive and `low` below `high`.
Histogram histogram(std::span<const double> values, double low, double high, std::size_t bins);

/// The value below which the share `fraction` (0 to 1) of `values` lies: the element of rank
/// ceil(fraction * n), at least the first. Rearranges `values`; 0 where there are none. O(n).
double quantile(std::vector<double>& values, double fraction);

}  // namespace burnish
