#include "burnish/core/adjacency.h"

namespace burnish {
namespace {

/// Rows from (row, item) pairs that `visit_pairs` gives twice in the same order.
template <class VisitPairs>
Adjacency rows_from(std::size_t rows, VisitPairs visit_pairs) {
  LargeVector<std::uint32_t> offsets(rows + 1, 0);
  visit_pairs([&](std::uint32_t row, std::uint32_t) { ++offsets[row + 1]; });
  for (std::size_t i = 1; i <= rows; ++i) offsets[i] += offsets[i - 1];
  LargeVector<std::uint32_t> items(offsets.back());
  LargeVector<std::uint32_t> next(offsets.begin(), offsets.end() - 1);
  visit_pairs([&](std::uint32_t row, std::uint32_t item) { items[next[row]++] = item; });
  return {std::move(offsets), std::move(items)};
}

/// Of every row of `ends` the neighbours that `keep(triangles on the edge to it)`.
template <class Keep>
Adjacency neighbours(const Adjacency& ends, Keep keep) {
  LargeVector<std::uint32_t> offsets{0}, items;
  offsets.reserve(ends.size() + 1);
  items.reserve(ends.items().size() / 2 + 1);
  for (std::size_t v = 0; v < ends.size(); ++v) {
    for_each_neighbour(ends.row(v), [&](std::uint32_t w, std::size_t triangles) {
      if (keep(triangles)) items.push_back(w);
    });
    offsets.push_back(static_cast<std::uint32_t>(items.size()));
  }
  return {std::move(offsets), std::move(items)};
}

}  // namespace

Adjacency triangles_of_vertices(const TriangleMesh& mesh) {
  return rows_from(mesh.positions.size(), [&](auto&& emit) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto [a, b, c] = mesh.triangles[t];
      emit(a, t);
      if (b != a) emit(b, t);
      if (c != a && c != b) emit(c, t);
    }
  });
}

Adjacency edge_ends(const TriangleMesh& mesh) {
  Adjacency unsorted = rows_from(mesh.positions.size(), [&](auto&& emit) {
    for (const auto& [a, b, c] : mesh.triangles) {
      if (a != b) emit(a, b), emit(b, a);
      if (b != c) emit(b, c), emit(c, b);
      if (c != a) emit(c, a), emit(a, c);
    }
  });
  // Every pair is there both ways, so that handing out the vertices in rising order to the rows in
  // which they stand fills rows of the same lengths, each in rising order.
  LargeVector<std::uint32_t> items(unsorted.items().size());
  LargeVector<std::uint32_t> next(unsorted.offsets().begin(), unsorted.offsets().end() - 1);
  for (std::uint32_t v = 0; v < unsorted.size(); ++v) {
    for (const std::uint32_t w : unsorted.row(v)) items[next[w]++] = v;
  }
  return {LargeVector<std::uint32_t>(unsorted.offsets()), std::move(items)};
}

Adjacency one_rings(const TriangleMesh& mesh) {
  return neighbours(edge_ends(mesh), [](std::size_t) { return true; });
}

std::vector<bool> boundary_vertices(const TriangleMesh& mesh) {
  const Adjacency ends = edge_ends(mesh);
  std::vector<bool> on_boundary(ends.size(), false);
  for (std::size_t v = 0; v < ends.size(); ++v) {
    for_each_neighbour(ends.row(v), [&](std::uint32_t, std::size_t triangles) {
      if (triangles != 2) on_boundary[v] = true;
    });
  }
  return on_boundary;
}

Adjacency boundary_neighbours(const TriangleMesh& mesh) {
  return neighbours(edge_ends(mesh), [](std::size_t triangles) { return triangles != 2; });
}

}  // namespace burnish
