#include "burnish/smoothing/ring_filter.h"

#include <algorithm>
#include <cmath>

namespace burnish {

SigmaFilter::SigmaFilter(const std::vector<float>& sigma)
    : variance_(sigma.begin(), sigma.end()), averaged_(sigma.size(), 1) {
  for (double& v : variance_) v *= v;
  next_ = variance_;
}

void SigmaFilter::move(std::size_t v, std::span<const std::uint32_t> neighbours, double own,
                       std::span<const double> weights, double scale) {
  double squares = own * own, sum = own * own * variance_[v];
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    const double square = weights[i] * scale * weights[i] * scale;
    squares += square;
    sum += square * variance_[neighbours[i]];
  }
  next_[v] = sum / squares;
  averaged_[v] += 1 / squares - 1;
}

void SigmaFilter::finish_pass() {
  // Vertices that never move have the same value in both.
  std::swap(variance_, next_);
}

std::vector<float> SigmaFilter::take() const {
  std::vector<float> sigma(variance_.size());
  for (std::size_t v = 0; v < sigma.size(); ++v) {
    sigma[v] = static_cast<float>(std::sqrt(variance_[v] / averaged_[v]));
  }
  return sigma;
}

bool for_in_order(const Context& context, std::size_t count,
                  const std::function<void(IndexRange)>& body) {
  constexpr std::size_t kGrain = 2048;
  for (std::size_t begin = 0; begin < count; begin += kGrain) {
    if (context.cancelled()) return false;
    const std::size_t end = std::min(count, begin + kGrain);
    body({begin, end});
    context.progress(static_cast<double>(end) / static_cast<double>(count));
  }
  return !context.cancelled();
}

}  // namespace burnish
