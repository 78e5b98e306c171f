#include "burnish/smoothing/ring_filter.h"

#include <algorithm>
#include <cmath>

namespace burnish {

Adjacency smoothing_rings(const TriangleMesh& mesh, BoundaryRule boundary) {
  if (boundary == BoundaryRule::free) return one_rings(mesh);
  const Adjacency ends = edge_ends(mesh);
  std::vector<std::uint32_t> offsets{0}, items;
  offsets.reserve(ends.size() + 1);
  items.reserve(ends.items().size() / 2);
  for (std::size_t v = 0; v < ends.size(); ++v) {
    const std::size_t begin = items.size();
    std::size_t along = begin;  // the neighbours along the boundary come to stand before this
    for_each_neighbour(ends.row(v), [&](std::uint32_t w, std::size_t triangles) {
      items.push_back(w);
      if (triangles != 2) items[along++] = w;
    });
    const bool on_boundary = along > begin;
    if (on_boundary) items.resize(boundary == BoundaryRule::along_boundary ? along : begin);
    offsets.push_back(static_cast<std::uint32_t>(items.size()));
  }
  return {std::move(offsets), std::move(items)};
}

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

std::vector<Vec3d> in_double(const std::vector<Vec3f>& positions) {
  std::vector<Vec3d> result(positions.size());
  std::transform(positions.begin(), positions.end(), result.begin(),
                 [](const Vec3f& p) { return Vec3d(p); });
  return result;
}

std::vector<Vec3f> in_float(const std::vector<Vec3d>& positions) {
  std::vector<Vec3f> result(positions.size());
  std::transform(positions.begin(), positions.end(), result.begin(),
                 [](const Vec3d& p) { return Vec3f(p); });
  return result;
}

std::size_t longest_row(const Adjacency& rows) {
  std::size_t longest = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) longest = std::max(longest, rows.row(i).size());
  return longest;
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
