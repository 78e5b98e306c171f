#include "burnish/adaptation/removal_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace burnish {
namespace {

constexpr std::size_t kBetweenReports = 4096;

/// Rows that are added one after the other.
struct Rows {
  LargeVector<std::uint32_t> offsets, items;

  explicit Rows(std::size_t count) {
    offsets.reserve(count + 1);
    offsets.push_back(0);
  }
  void close_row() { offsets.push_back(static_cast<std::uint32_t>(items.size())); }
  Adjacency finish() { return {std::move(offsets), std::move(items)}; }
};

/// For every entry j of row i, i as an entry of row j; rows rise.
Adjacency transposed(const Adjacency& rows) {
  LargeVector<std::uint32_t> offsets(rows.size() + 1, 0), items(rows.items().size());
  for (const std::uint32_t j : rows.items()) ++offsets[j + 1];
  for (std::size_t j = 0; j < rows.size(); ++j) offsets[j + 1] += offsets[j];
  std::vector<std::uint32_t> next(offsets.begin(), offsets.end() - 1);
  for (std::uint32_t i = 0; i < rows.size(); ++i) {
    for (const std::uint32_t j : rows.row(i)) items[next[j]++] = i;
  }
  return {std::move(offsets), std::move(items)};
}

Error in_removal(std::size_t number, std::string message) {
  return {ErrorCode::invalid_argument, std::move(message), fmt::format("removal {}", number)};
}

}  // namespace

Result<RemovalOrder> RemovalOrder::make(const TriangleMesh& mesh, std::span<const Removal> log,
                                        const Context& context) {
  RemovalReplay replay(mesh);
  RemovalOrder order;
  order.shapes_.reserve(log.size());
  Rows stars(log.size()), below(log.size());
  constexpr std::uint32_t kNone = ~0u;
  std::vector<std::uint32_t> latest(mesh.triangles.size(), kNone), beneath;
  float error = 0;
  for (std::uint32_t k = 0; k < log.size(); ++k) {
    if (k % kBetweenReports == 0) {
      if (context.cancelled()) return cancelled();
      context.progress(static_cast<double>(k) / static_cast<double>(log.size()));
    }
    if (!(log[k].error >= error) || !std::isfinite(log[k].error)) {
      return in_removal(
          k, fmt::format("the error {} after {}; errors never fall", log[k].error, error));
    }
    error = log[k].error;
    const Result<Star> star = replay.apply(log[k]);
    if (!star) return in_removal(k, star.error().message);
    order.shapes_.push_back(star->shape);
    beneath.clear();
    for (const std::uint32_t t : star->triangles) {
      stars.items.push_back(t);
      if (latest[t] != kNone) beneath.push_back(latest[t]);
      latest[t] = k;
    }
    std::sort(beneath.begin(), beneath.end());
    below.items.insert(below.items.end(), beneath.begin(),
                       std::unique(beneath.begin(), beneath.end()));
    stars.close_row();
    below.close_row();
  }
  order.stars_ = stars.finish();
  order.below_ = below.finish();
  order.above_ = transposed(order.below_);
  context.progress(1);
  return order;
}

}  // namespace burnish
