#include "burnish/points/orientation.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "burnish/core/adjacency.h"
#include "burnish/core/disjoint_sets.h"

namespace burnish {
namespace {

struct Link {
  float weight;
  std::uint32_t a, b;  ///< a < b

  friend bool operator<(const Link& l, const Link& m) {
    return std::tie(l.weight, l.a, l.b) < std::tie(m.weight, m.a, m.b);
  }
};

/// How far the normals of i and j look to the same side, -1 to 1. Along an arc from i to j the
/// normals are mirror images in the plane that bisects it, so that one is compared with the other's
/// mirror image: this holds across creases, where the normals themselves are at right angles.
double agreement(std::span<const Vec3f> positions, const std::vector<Vec3f>& normals,
                 std::uint32_t i, std::uint32_t j) {
  const Vec3d along = normalized(Vec3d(positions[j]) - Vec3d(positions[i]));
  const Vec3d m(normals[i]), n(normals[j]);
  const double rise_i = dot(m, along), rise_j = dot(n, along);
  const double steep = std::max(rise_i * rise_i, rise_j * rise_j);
  return (dot(m, n) - 2 * rise_i * rise_j) * (1 - steep);
}

using LinkIterator = std::vector<Link>::iterator;

/// Sorts in pieces that are short enough to stop between them.
void sort_links(LinkIterator begin, LinkIterator end, const Context& context) {
  constexpr std::ptrdiff_t kPiece = 200000;
  if (context.cancelled()) return;
  if (end - begin <= kPiece) {
    std::sort(begin, end);
    return;
  }
  const LinkIterator middle = begin + (end - begin) / 2;
  std::nth_element(begin, middle, end);
  sort_links(begin, middle, context);
  sort_links(middle, end, context);
}

/// The links of the minimum spanning tree, Kruskal's way; of a part where it is cancelled.
std::vector<Link> spanning_links(std::span<const Vec3f> positions,
                                 std::span<const std::uint32_t> neighbours, std::size_t count,
                                 const std::vector<Vec3f>& normals, const Context& context) {
  constexpr std::uint32_t kCheckStop = 1 << 14;
  std::vector<Link> links;
  for (std::uint32_t i = 0; i < normals.size(); ++i) {
    if (i % kCheckStop == 0 && context.cancelled()) return {};
    if (normals[i] == Vec3f{}) continue;
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t j = neighbours[i * count + k];
      if (j == i || normals[j] == Vec3f{}) continue;
      const auto back = neighbours.subspan(j * count, count);
      if (j < i && std::find(back.begin(), back.end(), i) != back.end()) continue;  // had it
      const double weight =
          1 - std::abs(agreement(positions, normals, std::min(i, j), std::max(i, j)));
      links.push_back({static_cast<float>(weight), std::min(i, j), std::max(i, j)});
    }
  }
  sort_links(links.begin(), links.end(), context);
  if (context.cancelled()) return {};
  DisjointSets sets(normals.size());
  std::erase_if(links, [&](const Link& link) { return !sets.unite(link.a, link.b); });
  return links;
}

/// The tree as lists of neighbours.
Adjacency tree_of(const std::vector<Link>& links, std::size_t count) {
  std::vector<std::uint32_t> offsets(count + 1), items(2 * links.size());
  for (const Link& link : links) ++offsets[link.a + 1], ++offsets[link.b + 1];
  for (std::size_t i = 0; i < count; ++i) offsets[i + 1] += offsets[i];
  std::vector<std::uint32_t> next(offsets.begin(), offsets.end() - 1);
  for (const Link& link : links) {
    items[next[link.a]++] = link.b;
    items[next[link.b]++] = link.a;
  }
  return {std::move(offsets), std::move(items)};
}

}  // namespace

std::size_t orient_consistently(std::span<const Vec3f> positions,
                                std::span<const std::uint32_t> neighbours, std::size_t count,
                                std::vector<Vec3f>& normals, const Context& context) {
  const Adjacency tree =
      tree_of(spanning_links(positions, neighbours, count, normals, context), normals.size());
  if (context.cancelled()) return 0;
  std::vector<std::uint32_t> from_top;
  for (std::uint32_t i = 0; i < normals.size(); ++i) {
    if (normals[i] != Vec3f{}) from_top.push_back(i);
  }
  std::stable_sort(from_top.begin(), from_top.end(), [&](std::uint32_t a, std::uint32_t b) {
    return positions[a].z > positions[b].z;
  });

  std::size_t components = 0;
  std::vector<std::uint8_t> oriented(normals.size());
  std::vector<std::uint32_t> open;
  for (const std::uint32_t top : from_top) {
    if (oriented[top]) continue;
    ++components;
    if (normals[top].z < 0) normals[top] = -normals[top];
    oriented[top] = 1;
    open.assign(1, top);
    while (!open.empty()) {
      const std::uint32_t i = open.back();
      open.pop_back();
      for (const std::uint32_t j : tree.row(i)) {
        if (oriented[j]) continue;
        if (agreement(positions, normals, i, j) < 0) normals[j] = -normals[j];
        oriented[j] = 1;
        open.push_back(j);
      }
    }
  }
  return components;
}

}  // namespace burnish
