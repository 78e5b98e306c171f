#include "burnish/smoothing/ring_sweep.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "burnish/base/parallel_passes.h"

namespace burnish {
namespace {

constexpr int kFewPasses = 4;      ///< to sort tiles costs as much as fewer passes can save
constexpr int kSomePasses = 8;     ///< and to number all vertices anew
constexpr int kMostTogether = 16;  ///< passes: more would save nothing
constexpr std::uint32_t kNone = ~0u;

std::size_t longest_row(const Adjacency& rows) {
  std::size_t longest = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) longest = std::max(longest, rows.row(i).size());
  return longest;
}

/// Appends the vertices that can be reached from those in order[first..] and have no rank yet.
/// False where the context was cancelled.
bool spread(const Context& context, const Adjacency& rings, std::size_t first,
            LargeVector<std::uint32_t>& order, LargeVector<std::uint32_t>& rank,
            std::size_t& count) {
  for (std::size_t next = first; next < count; ++next) {
    if (next % 65536 == 0 && context.cancelled()) return false;
    for (const std::uint32_t w : rings.row(order[next])) {
      // Whether a neighbour is new cannot be predicted, so no branch may depend on it.
      const bool is_new = rank[w] == kNone;
      order[count] = w;
      rank[w] = is_new ? static_cast<std::uint32_t>(count) : rank[w];
      count += is_new;
    }
  }
  return true;
}

/// Stable; rings of kLengths or more neighbours are not told apart.
void sort_by_length(const Adjacency& rings, std::span<std::uint32_t> vertices) {
  constexpr std::size_t kLengths = 64;
  std::array<std::uint32_t, kLengths + 1> place{};
  const auto length_of = [&](std::uint32_t v) {
    return std::min(rings.row(v).size(), kLengths - 1);
  };
  for (const std::uint32_t v : vertices) ++place[length_of(v) + 1];
  std::partial_sum(place.begin(), place.end(), place.begin());
  std::vector<std::uint32_t> sorted(vertices.size());
  for (const std::uint32_t v : vertices) sorted[place[length_of(v)]++] = v;
  std::copy(sorted.begin(), sorted.end(), vertices.begin());
}

}  // namespace

double RingSweep::bytes_per_vertex() const {
  return 2 * sizeof(Vec3d) + sizeof(std::uint32_t) * (1 + static_cast<double>(ring_items()) /
                                                              static_cast<double>(size_));
}

/// What two passes of a wave that follow each other have between them.
double RingSweep::bytes_apart() const {
  double apart = 0;
  for (std::size_t tile = 0; tile < needs_.size(); ++tile) {
    apart += static_cast<double>(needs_[tile] - tile);
  }
  return apart / static_cast<double>(needs_.size()) * static_cast<double>(tile_) *
         bytes_per_vertex();
}

/// A tile waits for all that it reads, and for all that read it. starts: per tile its first item,
/// and the end of the last.
void RingSweep::find_reach(const std::vector<std::size_t>& starts,
                           std::span<const std::uint32_t> items) {
  needs_.resize(tiles());
  for (std::uint32_t tile = 0; tile < needs_.size(); ++tile) needs_[tile] = tile + 1;
  for (std::uint32_t tile = 0; tile < needs_.size(); ++tile) {
    std::uint32_t lowest = kNone, highest = 0;
    for (std::size_t i = starts[tile]; i < starts[tile + 1]; ++i) {
      lowest = std::min(lowest, items[i]);
      highest = std::max(highest, items[i]);
    }
    if (lowest == kNone) continue;
    const std::size_t first = lowest / tile_;
    needs_[first] = std::max(needs_[first], tile + 1);
    needs_[tile] = std::max(needs_[tile], static_cast<std::uint32_t>(highest / tile_ + 1));
  }
  // Tiles come in their order, so that one behind another needs no less.
  std::partial_sum(needs_.begin(), needs_.end(), needs_.begin(),
                   [](std::uint32_t a, std::uint32_t b) { return std::max(a, b); });
}

bool RingSweep::number_breadth_first(const Context& context) {
  order_.resize(size_ + 1);  // a place for the one that turns out to have been there
  LargeVector<std::uint32_t> rank(size_, kNone);
  std::size_t count = 0;
  for (std::uint32_t seed = 0; seed < size_; ++seed) {
    if (rank[seed] != kNone) continue;
    const std::size_t first = count;
    rank[seed] = static_cast<std::uint32_t>(count);
    order_[count++] = seed;
    if (!spread(context, rings_, first, order_, rank, count)) return false;
  }
  order_.resize(size_);
  return true;
}

/// Puts the vertices of each tile in the order of the lengths of their rings, and the rings, with
/// the new numbers, one behind the other.
bool RingSweep::sort_tiles(const Context& context) {
  LargeVector<std::uint32_t> rank(size_);
  std::vector<std::size_t> lengths(tiles(), 0);
  runs_.resize(tiles());
  const auto every_tile = [&](auto body) {
    return parallel_for(
        context, tiles(),
        [&](IndexRange range) {
          for (std::size_t tile = range.begin; tile < range.end; ++tile) body(tile);
        },
        8);
  };
  const bool sorted = every_tile([&](std::size_t tile) {
    const IndexRange range = vertices(tile);
    sort_by_length(rings_, std::span(order_).subspan(range.begin, range.end - range.begin));
    std::vector<RingTile::Run>& runs = runs_[tile];
    for (std::size_t v = range.begin; v < range.end; ++v) {
      rank[order_[v]] = static_cast<std::uint32_t>(v);
      const auto length = static_cast<std::uint32_t>(rings_.row(order_[v]).size());
      if (runs.empty() || runs.back().length != length) runs.push_back({0, length});
      runs.back().end = static_cast<std::uint32_t>(v + 1);
      lengths[tile] += length;
    }
  });
  if (!sorted) return false;
  first_item_.assign(tiles() + 1, 0);
  std::partial_sum(lengths.begin(), lengths.end(), first_item_.begin() + 1);
  items_.resize(first_item_.back());
  return every_tile([&](std::size_t tile) {
    std::uint32_t* item = items_.data() + first_item_[tile];
    const IndexRange range = vertices(tile);
    for (std::size_t v = range.begin; v < range.end; ++v) {
      for (const std::uint32_t w : rings_.row(order_[v])) *item++ = rank[w];
    }
  });
}

bool RingSweep::lay_out(const Context& context, Adjacency rings, int passes,
                        const SweepLayout& layout) {
  rings_ = std::move(rings);
  size_ = rings_.size();
  tile_ = layout.tile;
  longest_ = longest_row(rings_);
  if (size_ == 0) return true;
  const auto cache = static_cast<double>(layout.cache);
  std::vector<std::size_t> starts;
  for (std::size_t v = 0; v < size_; v += tile_) starts.push_back(rings_.offsets()[v]);
  starts.push_back(rings_.items().size());
  find_reach(starts, rings_.items());
  if (layout.numbering == Numbering::near && passes >= kFewPasses) {
    Context quiet = context;
    quiet.sink = nullptr;
    const bool fits = static_cast<double>(size_) * bytes_per_vertex() <= cache;
    if (fits || passes < kSomePasses || kFewPasses * bytes_apart() <= cache) {
      order_.resize(size_);
      std::iota(order_.begin(), order_.end(), 0u);
    } else if (!number_breadth_first(quiet)) {
      return false;
    }
    if (!sort_tiles(quiet)) return false;
    rings_ = {};
    find_reach(first_item_, items_);
  }
  together_ = static_cast<int>(std::clamp(cache / bytes_apart(), 1., double{kMostTogether}));
  return true;
}

bool RingSweep::run(const Context& context, int passes,
                    const std::function<void(int, const RingTile&)>& body) const {
  for (int first = 0; first < passes; first += together_) {
    const int count = std::min(together_, passes - first);
    Context share = context.part(static_cast<double>(first) / passes,
                                 static_cast<double>(first + count) / passes);
    if (is_little_work(ring_items(), passes)) share.threads = 1;
    const bool complete = parallel_passes(
        share, static_cast<std::size_t>(count), needs_, [&](std::size_t pass, std::size_t tile) {
          const IndexRange range = vertices(tile);
          const auto begin = static_cast<std::uint32_t>(range.begin),
                     end = static_cast<std::uint32_t>(range.end);
          const RingTile rings = runs_.empty() ? RingTile(begin, end, rings_)
                                               : RingTile(begin, end, runs_[tile].data(),
                                                          items_.data() + first_item_[tile]);
          body(first + static_cast<int>(pass), rings);
        });
    if (!complete) return false;
  }
  return true;
}

}  // namespace burnish
