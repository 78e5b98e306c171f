#include "burnish/core/edge_table.h"

#include <algorithm>

#include "burnish/base/parallel.h"

namespace burnish {
namespace {

/// A side of a triangle in the bucket of the smaller of its two vertices.
struct Entry {
  std::uint32_t high, side;
};

struct Buckets {
  std::vector<std::uint32_t> starts;  ///< #V + 1
  LargeVector<Entry> entries;

  std::span<Entry> of(std::size_t low) {
    return {entries.data() + starts[low], entries.data() + starts[low + 1]};
  }
};

template <class Visit>
void for_each_side(const TriangleMesh& mesh, Visit visit) {
  std::uint32_t side = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    if (a != b) visit(std::min(a, b), Entry{std::max(a, b), side});
    if (b != c) visit(std::min(b, c), Entry{std::max(b, c), side + 1});
    if (c != a) visit(std::min(c, a), Entry{std::max(c, a), side + 2});
    side += 3;
  }
}

Buckets buckets_of(const TriangleMesh& mesh) {
  Buckets buckets;
  std::vector<std::uint32_t>& starts = buckets.starts;
  starts.assign(mesh.positions.size() + 1, 0);
  for_each_side(mesh, [&](std::uint32_t low, const Entry&) { ++starts[low + 1]; });
  for (std::size_t v = 1; v < starts.size(); ++v) starts[v] += starts[v - 1];
  buckets.entries.resize(starts.back());
  std::vector<std::uint32_t> next(starts.begin(), starts.end() - 1);
  for_each_side(
      mesh, [&](std::uint32_t low, const Entry& entry) { buckets.entries[next[low]++] = entry; });
  return buckets;
}

/// By the other vertex, then by side; gives the number of edges. Sides come in rising, and mostly
/// there are few.
std::uint32_t sort_bucket(std::span<Entry> bucket) {
  std::sort(bucket.begin(), bucket.end(), [](const Entry& a, const Entry& b) {
    return a.high != b.high ? a.high < b.high : a.side < b.side;
  });
  std::uint32_t edges = 0;
  for (std::size_t i = 0; i < bucket.size(); ++i) {
    edges += i == 0 || bucket[i].high != bucket[i - 1].high;
  }
  return edges;
}

}  // namespace

std::optional<EdgeTable> EdgeTable::of(const TriangleMesh& mesh, const Context& context) {
  if (context.cancelled()) return {};
  Buckets buckets = buckets_of(mesh);
  const std::size_t vertices = mesh.positions.size();
  std::vector<std::uint32_t> first_edge(vertices + 1, 0);
  const bool sorted = parallel_for(context.part(0.3, 0.7), vertices, [&](IndexRange range) {
    for (std::size_t v = range.begin; v < range.end; ++v) {
      first_edge[v + 1] = sort_bucket(buckets.of(v));
    }
  });
  if (!sorted) return {};
  for (std::size_t v = 0; v < vertices; ++v) first_edge[v + 1] += first_edge[v];

  EdgeTable table;
  table.vertices_.resize(first_edge.back());
  table.first_side_.resize(table.vertices_.size() + 1);
  table.sides_.resize(buckets.entries.size());
  table.of_side_.assign(3 * mesh.triangles.size(), kNoEdge);
  const bool numbered = parallel_for(context.part(0.7, 1), vertices, [&](IndexRange range) {
    for (std::size_t v = range.begin; v < range.end; ++v) {
      std::uint32_t edge = first_edge[v];
      const std::span<const Entry> bucket = buckets.of(v);
      for (std::size_t i = 0; i < bucket.size(); ++i) {
        const std::uint32_t at = buckets.starts[v] + static_cast<std::uint32_t>(i);
        if (i == 0 || bucket[i].high != bucket[i - 1].high) {
          table.vertices_[edge] = {static_cast<std::uint32_t>(v), bucket[i].high};
          table.first_side_[edge++] = at;
        }
        table.sides_[at] = bucket[i].side;
        table.of_side_[bucket[i].side] = edge - 1;
      }
    }
  });
  if (!numbered) return {};
  table.first_side_.back() = static_cast<std::uint32_t>(buckets.entries.size());
  return table;
}

}  // namespace burnish
