#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "burnish/base/large_vector.h"
#include "burnish/base/parallel.h"
#include "burnish/core/adjacency.h"

// In which order a sweep over rings takes vertices, and how close passes can follow each other.
// Not part of the library's interface.
namespace burnish {

/// Vertices cut into tiles of 2^bits; the first tile is the one that may be shorter.
struct Tiling {
  std::size_t vertices = 0;
  unsigned bits = 0;

  std::size_t length() const { return std::size_t{1} << bits; }
  std::size_t count() const { return (vertices + length() - 1) >> bits; }
  std::size_t short_by() const { return (count() << bits) - vertices; }
  std::size_t tile_of(std::size_t v) const { return (v + short_by()) >> bits; }
  IndexRange range(std::size_t tile) const {
    const std::size_t begin = std::max(tile << bits, short_by()) - short_by();
    return {begin, ((tile + 1) << bits) - short_by()};
  }
};

/// Which tiles have neighbours in which others, both ways. items[starts[t]..starts[t + 1]] are the
/// neighbours of the vertices of tile t. None where tiles are joined to very many others.
std::optional<Adjacency> joined_tiles(const Tiling& tiling, std::span<const std::size_t> starts,
                                      std::span<const std::uint32_t> items);

/// All elements in the order in which a breadth-first search from the first one finds them, and
/// then from the first that is left. False where the context was cancelled.
[[nodiscard]] bool breadth_first(const Context& context, const Adjacency& joined,
                                 LargeVector<std::uint32_t>& order);

/// What parallel_passes needs where tiles come in that order; everything where `joined` is none.
std::vector<std::uint32_t> needs_of(const Tiling& tiling, const std::optional<Adjacency>& joined,
                                    std::span<const std::uint32_t> order);

}  // namespace burnish
