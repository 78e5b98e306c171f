#include "burnish/sensor/nearest_time.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace burnish {

NearestTime::NearestTime(std::vector<double> times)
    : times_(std::move(times)), order_(times_.size()) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::stable_sort(order_.begin(), order_.end(),
                   [this](std::size_t a, std::size_t b) { return times_[a] < times_[b]; });
}

std::optional<std::size_t> NearestTime::find(double time, double window) const {
  if (order_.empty()) return std::nullopt;
  const auto gap = [&](std::size_t i) { return std::abs(times_[i] - time); };
  const auto after =
      std::lower_bound(order_.begin(), order_.end(), time,
                       [this](std::size_t i, double value) { return times_[i] < value; });
  auto nearest = after == order_.end() ? after - 1 : after;
  if (after != order_.begin() && gap(*(after - 1)) <= gap(*nearest)) nearest = after - 1;
  if (!(gap(*nearest) <= window)) return std::nullopt;
  return *nearest;
}

}  // namespace burnish
