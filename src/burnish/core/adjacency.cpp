#include "burnish/core/adjacency.h"

#include <algorithm>

namespace burnish {
namespace {

using Numbers = LargeVector<std::uint32_t>;

/// Counts per row, each one place behind its own, become where rows begin.
void add_up(Numbers& offsets) {
  for (std::size_t i = 1; i < offsets.size(); ++i) offsets[i] += offsets[i - 1];
}

/// Calls `visit(from, to)` for the edges of every triangle in its direction.
template <class Visit>
void visit_edges(const TriangleMesh& mesh, Visit visit) {
  for (const auto& [a, b, c] : mesh.triangles) {
    if (a != b) visit(a, b);
    if (b != c) visit(b, c);
    if (c != a) visit(c, a);
  }
}

/// Per vertex where the edges of its triangles lead to and where they come from, both rising: an
/// inner neighbour is once in each, one along a boundary in one of them. A triangle has one edge to
/// each of its vertices and one from it, so that both rows of a vertex are equally long.
class EdgeEnds {
 public:
  explicit EdgeEnds(const TriangleMesh& mesh) : offsets_(mesh.positions.size() + 1, 0) {
    visit_edges(mesh, [this](std::uint32_t from, std::uint32_t) { ++offsets_[from + 1]; });
    add_up(offsets_);
    heads_.resize(offsets_.back());
    tails_.resize(offsets_.back());
    Numbers next(offsets_.begin(), offsets_.end() - 1);
    visit_edges(mesh, [&](std::uint32_t from, std::uint32_t to) { heads_[next[from]++] = to; });
    // To hand out vertices in rising order to the rows of those that they are joined to fills these
    // in rising order.
    turn_round(heads_, tails_, next);
    turn_round(tails_, heads_, next);
  }

  std::size_t size() const { return offsets_.size() - 1; }
  std::span<const std::uint32_t> heads(std::size_t v) const { return row(heads_, v); }
  std::span<const std::uint32_t> tails(std::size_t v) const { return row(tails_, v); }

  /// Whether the triangles of v lie around it in one sense, each edge between two of them: then its
  /// neighbours are its tails.
  bool closed(std::size_t v) const {
    const auto to = heads(v), from = tails(v);
    bool closed = true;
    for (std::size_t i = 0; i < to.size(); ++i) closed &= to[i] == from[i];
    for (std::size_t i = 1; i < to.size(); ++i) closed &= to[i - 1] < to[i];
    return closed;
  }

  /// Calls `visit(neighbour, triangles)` for every distinct neighbour, rising, with the number of
  /// triangles on the edge to it.
  template <class Visit>
  void for_each_neighbour(std::size_t v, Visit visit) const {
    const auto to = heads(v), from = tails(v);
    for (std::size_t i = 0, k = 0; i < to.size() || k < from.size();) {
      const std::uint32_t w = i == to.size()                        ? from[k]
                              : k == from.size() || to[i] < from[k] ? to[i]
                                                                    : from[k];
      const std::size_t before = i + k;
      while (i < to.size() && to[i] == w) ++i;
      while (k < from.size() && from[k] == w) ++k;
      visit(w, i + k - before);
    }
  }

  bool on_boundary(std::size_t v) const {
    bool found = false;
    for_each_neighbour(v, [&](std::uint32_t, std::size_t triangles) { found |= triangles != 2; });
    return found;
  }

  std::size_t tails_in_all() const { return tails_.size(); }
  Adjacency take_tails() { return {std::move(offsets_), std::move(tails_)}; }

 private:
  std::span<const std::uint32_t> row(const Numbers& items, std::size_t v) const {
    return {items.data() + offsets_[v], items.data() + offsets_[v + 1]};
  }
  void turn_round(const Numbers& from, Numbers& to, Numbers& next) const {
    std::copy(offsets_.begin(), offsets_.end() - 1, next.begin());
    for (std::uint32_t v = 0; v < size(); ++v) {
      for (const std::uint32_t w : row(from, v)) to[next[w]++] = v;
    }
  }

  Numbers offsets_, heads_, tails_;
};

/// What rows of neighbours hold: those of vertices that do not lie on a boundary, or nothing; and
/// of those that do.
struct Rows {
  bool inner;
  BoundaryRings at_boundary;
};

Adjacency neighbours(EdgeEnds ends, const Rows& rows) {
  std::size_t first_open = 0;
  while (first_open < ends.size() && ends.closed(first_open)) ++first_open;
  if (first_open == ends.size() && rows.inner) return ends.take_tails();

  Numbers offsets(ends.size() + 1), items;
  offsets[0] = 0;
  if (rows.inner) items.reserve(ends.tails_in_all());
  for (std::size_t v = 0; v < ends.size(); ++v) {
    const bool closed = v < first_open || ends.closed(v);
    if (closed && rows.inner) {
      items.insert(items.end(), ends.tails(v).begin(), ends.tails(v).end());
    } else if (!closed) {
      const bool inner = !ends.on_boundary(v);
      const bool all = inner ? rows.inner : rows.at_boundary == BoundaryRings::all;
      const bool along = !inner && rows.at_boundary == BoundaryRings::along_boundary;
      ends.for_each_neighbour(v, [&](std::uint32_t w, std::size_t triangles) {
        if (all || (along && triangles != 2)) items.push_back(w);
      });
    }
    offsets[v + 1] = static_cast<std::uint32_t>(items.size());
  }
  return {std::move(offsets), std::move(items)};
}

}  // namespace

Adjacency triangles_of_vertices(const TriangleMesh& mesh) {
  const auto visit_corners = [&](auto visit) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto [a, b, c] = mesh.triangles[t];
      visit(a, t);
      if (b != a) visit(b, t);
      if (c != a && c != b) visit(c, t);
    }
  };
  Numbers offsets(mesh.positions.size() + 1, 0);
  visit_corners([&](std::uint32_t v, std::uint32_t) { ++offsets[v + 1]; });
  add_up(offsets);
  Numbers items(offsets.back()), next(offsets.begin(), offsets.end() - 1);
  visit_corners([&](std::uint32_t v, std::uint32_t t) { items[next[v]++] = t; });
  return {std::move(offsets), std::move(items)};
}

Adjacency one_rings(const TriangleMesh& mesh, BoundaryRings at_boundary) {
  return neighbours(EdgeEnds(mesh), {true, at_boundary});
}

std::vector<bool> boundary_vertices(const TriangleMesh& mesh) {
  const EdgeEnds ends(mesh);
  std::vector<bool> on_boundary(ends.size());
  for (std::size_t v = 0; v < ends.size(); ++v) on_boundary[v] = ends.on_boundary(v);
  return on_boundary;
}

Adjacency boundary_neighbours(const TriangleMesh& mesh) {
  return neighbours(EdgeEnds(mesh), {false, BoundaryRings::along_boundary});
}

}  // namespace burnish
