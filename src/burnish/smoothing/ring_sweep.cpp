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

LargeVector<std::uint32_t> counted(std::size_t count) {
  LargeVector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0u);
  return numbers;
}

std::size_t longest_row(const Adjacency& rows) {
  std::size_t longest = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) longest = std::max(longest, rows.row(i).size());
  return longest;
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
                                                              static_cast<double>(size()));
}

/// What two passes of a wave that follow each other have between them.
double RingSweep::bytes_apart() const {
  double apart = 0;
  for (std::size_t tile = 0; tile < needs_.size(); ++tile) {
    apart += static_cast<double>(needs_[tile] - tile);
  }
  return apart / static_cast<double>(needs_.size()) * static_cast<double>(tiling_.length()) *
         bytes_per_vertex();
}

/// Puts vertices in an order in which rings lead to near tiles, as far as that pays.
bool RingSweep::number_anew(const Context& context, double cache, int passes) {
  const auto is_near = [&] { return kFewPasses * bytes_apart() <= cache; };
  std::vector<std::size_t> starts;
  for (std::size_t tile = 0; tile < tiling_.count(); ++tile) {
    starts.push_back(rings_.offsets()[tiling_.range(tile).begin]);
  }
  starts.push_back(rings_.items().size());
  const std::optional<Adjacency> joined = joined_tiles(tiling_, starts, rings_.items());
  LargeVector<std::uint32_t> tiles = counted(tiling_.count());
  needs_ = needs_of(tiling_, joined, tiles);
  order_.clear();
  if (passes < kFewPasses) return true;
  if (joined && !is_near()) {
    if (!breadth_first(context, *joined, tiles)) return false;
    needs_ = needs_of(tiling_, joined, tiles);
  }
  if (!is_near() && passes >= kSomePasses) {
    needs_.clear();  // nothing is known of the tiles that come of this
    return breadth_first(context, rings_, order_);
  }
  order_.reserve(size());
  for (const std::uint32_t tile : tiles) {
    const IndexRange range = tiling_.range(tile);
    for (std::size_t v = range.begin; v < range.end; ++v) {
      order_.push_back(static_cast<std::uint32_t>(v));
    }
  }
  return true;
}

/// Puts the vertices of each tile in the order of the lengths of their rings, and the rings, with
/// the new numbers, one behind the other.
bool RingSweep::sort_tiles(const Context& context) {
  const std::size_t tiles = tiling_.count();
  LargeVector<std::uint32_t> rank(size());
  std::vector<std::size_t> lengths(tiles, 0);
  runs_.resize(tiles);
  const auto every_tile = [&](auto body) {
    return parallel_for(
        context, tiles,
        [&](IndexRange range) {
          for (std::size_t tile = range.begin; tile < range.end; ++tile) body(tile);
        },
        8);
  };
  const bool sorted = every_tile([&](std::size_t tile) {
    const IndexRange range = tiling_.range(tile);
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
  first_item_.assign(tiles + 1, 0);
  std::partial_sum(lengths.begin(), lengths.end(), first_item_.begin() + 1);
  items_.resize(first_item_.back());
  return every_tile([&](std::size_t tile) {
    std::uint32_t* item = items_.data() + first_item_[tile];
    const IndexRange range = tiling_.range(tile);
    for (std::size_t v = range.begin; v < range.end; ++v) {
      for (const std::uint32_t w : rings_.row(order_[v])) *item++ = rank[w];
    }
  });
}

bool RingSweep::lay_out(const Context& context, Adjacency rings, int passes,
                        const SweepLayout& layout) {
  rings_ = std::move(rings);
  tiling_ = {rings_.size(), layout.tile_bits};
  longest_ = longest_row(rings_);
  effort_ = layout.effort;
  if (size() == 0) return true;
  Context quiet = context;
  quiet.sink = nullptr;
  if (is_little_work(ring_items(), passes, effort_)) quiet.threads = 1;
  // What is numbered as given saves nothing by other numbers.
  const int saving = layout.numbering == Numbering::as_given ? 0 : passes;
  const auto cache = static_cast<double>(layout.cache);
  if (passes < 2 || static_cast<double>(size()) * bytes_per_vertex() <= cache) {
    needs_.assign(tiling_.count(), static_cast<std::uint32_t>(tiling_.count()));
    if (saving >= kFewPasses) order_ = counted(size());
  } else if (!number_anew(quiet, cache, saving)) {
    return false;
  }
  if (!order_.empty()) {
    if (!sort_tiles(quiet)) return false;
    rings_ = {};
  }
  if (needs_.empty()) {
    needs_ =
        needs_of(tiling_, joined_tiles(tiling_, first_item_, items_), counted(tiling_.count()));
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
    if (is_little_work(ring_items(), passes, effort_)) share.threads = 1;
    const bool complete = parallel_passes(
        share, static_cast<std::size_t>(count), needs_, [&](std::size_t pass, std::size_t tile) {
          const IndexRange range = tiling_.range(tile);
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
