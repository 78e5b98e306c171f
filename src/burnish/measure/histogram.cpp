#include "burnish/measure/histogram.h"

#include <algorithm>
#include <cmath>

namespace burnish {

Histogram histogram(std::span<const double> values, double low, double high, std::size_t bins) {
  Histogram result{low, high, std::vector<std::uint64_t>(bins, 0)};
  const auto last = static_cast<double>(bins - 1);
  for (const double value : values) {
    const double bin = std::floor((value - low) / (high - low) * static_cast<double>(bins));
    ++result.counts[static_cast<std::size_t>(std::clamp(bin, 0.0, last))];
  }
  return result;
}

double quantile(std::vector<double>& values, double fraction) {
  if (values.empty()) return 0;
  const double rank = std::ceil(fraction * static_cast<double>(values.size()));
  const double index = std::clamp(rank - 1, 0.0, static_cast<double>(values.size() - 1));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(index);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace burnish
