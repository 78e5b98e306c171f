#include "burnish/smoothing/tile_order.h"

#include <numeric>

namespace burnish {
namespace {

constexpr std::uint32_t kNone = ~0u;
constexpr std::size_t kManyTiles = 32;  ///< joined to one on average: there is no near and far

Adjacency rows_of(const std::vector<std::vector<std::uint32_t>>& lists) {
  LargeVector<std::uint32_t> offsets{0}, items;
  for (const auto& list : lists) {
    items.insert(items.end(), list.begin(), list.end());
    offsets.push_back(static_cast<std::uint32_t>(items.size()));
  }
  return {std::move(offsets), std::move(items)};
}

}  // namespace

std::optional<Adjacency> joined_tiles(const Tiling& tiling, std::span<const std::size_t> starts,
                                      std::span<const std::uint32_t> items) {
  const std::size_t count = tiling.count();
  std::vector<std::vector<std::uint32_t>> joined(count);
  std::vector<std::uint32_t> seen_from(count, kNone);
  std::size_t links = 0;
  for (std::uint32_t tile = 0; tile < count; ++tile) {
    seen_from[tile] = tile;
    for (std::size_t i = starts[tile]; i < starts[tile + 1]; ++i) {
      const std::size_t other = tiling.tile_of(items[i]);
      if (seen_from[other] == tile) continue;
      seen_from[other] = tile;
      joined[tile].push_back(static_cast<std::uint32_t>(other));
      joined[other].push_back(tile);
      if (++links > kManyTiles * count) return {};
    }
  }
  return rows_of(joined);
}

bool breadth_first(const Context& context, const Adjacency& joined,
                   LargeVector<std::uint32_t>& order) {
  LargeVector<std::uint32_t> rank(joined.size(), kNone);
  order.resize(joined.size() + 1);  // a place for the last one that turns out to have been there
  std::size_t count = 0, next = 0;
  for (std::uint32_t first = 0; first < joined.size(); ++first) {
    if (rank[first] != kNone) continue;
    rank[first] = static_cast<std::uint32_t>(count);
    order[count++] = first;
    for (; next < count; ++next) {
      if (next % 65536 == 0 && context.cancelled()) return false;
      for (const std::uint32_t w : joined.row(order[next])) {
        // Whether a neighbour is new cannot be predicted, so no branch may depend on it.
        const bool is_new = rank[w] == kNone;
        order[count] = w;
        rank[w] = is_new ? static_cast<std::uint32_t>(count) : rank[w];
        count += is_new;
      }
    }
  }
  order.resize(joined.size());
  return true;
}

std::vector<std::uint32_t> needs_of(const Tiling& tiling, const std::optional<Adjacency>& joined,
                                    std::span<const std::uint32_t> order) {
  const auto count = static_cast<std::uint32_t>(tiling.count());
  std::vector<std::uint32_t> needs(count, count);
  if (!joined) return needs;
  std::vector<std::uint32_t> place(count);
  for (std::uint32_t i = 0; i < count; ++i) place[order[i]] = i;
  for (std::uint32_t i = 0; i < count; ++i) {
    needs[i] = i + 1;
    for (const std::uint32_t tile : joined->row(order[i])) {
      needs[i] = std::max(needs[i], place[tile] + 1);
    }
  }
  // Tiles come in their order, so that one behind another needs no less.
  std::partial_sum(needs.begin(), needs.end(), needs.begin(),
                   [](std::uint32_t a, std::uint32_t b) { return std::max(a, b); });
  return needs;
}

}  // namespace burnish
