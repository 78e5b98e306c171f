#include "burnish/core/adjacency.h"

#include <algorithm>

#include "burnish/core/edges.h"

namespace burnish {
namespace {

/// Rows from (row, item) pairs that `visit_pairs` gives twice in the same order.
template <class VisitPairs>
Adjacency rows_from(std::size_t rows, VisitPairs visit_pairs) {
  std::vector<std::uint32_t> offsets(rows + 1, 0);
  visit_pairs([&](std::uint32_t row, std::uint32_t) { ++offsets[row + 1]; });
  for (std::size_t i = 1; i <= rows; ++i) offsets[i] += offsets[i - 1];
  std::vector<std::uint32_t> items(offsets.back());
  std::vector<std::uint32_t> next(offsets.begin(), offsets.end() - 1);
  visit_pairs([&](std::uint32_t row, std::uint32_t item) { items[next[row]++] = item; });
  return {std::move(offsets), std::move(items)};
}

/// The rows with every row sorted and its repeats dropped.
Adjacency distinct(const Adjacency& rows) {
  std::vector<std::uint32_t> offsets{0}, items;
  offsets.reserve(rows.size() + 1);
  items.reserve(rows.items().size() / 2 + 1);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto row = rows.row(i);
    const auto begin = static_cast<std::ptrdiff_t>(items.size());
    items.insert(items.end(), row.begin(), row.end());
    std::sort(items.begin() + begin, items.end());
    items.erase(std::unique(items.begin() + begin, items.end()), items.end());
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

Adjacency one_rings(const TriangleMesh& mesh) {
  return distinct(rows_from(mesh.positions.size(), [&](auto&& emit) {
    for (const auto& [a, b, c] : mesh.triangles) {
      if (a != b) emit(a, b), emit(b, a);
      if (b != c) emit(b, c), emit(c, b);
      if (c != a) emit(c, a), emit(a, c);
    }
  }));
}

std::vector<bool> boundary_vertices(const TriangleMesh& mesh) {
  std::vector<bool> on_boundary(mesh.positions.size(), false);
  for (const Edge& edge : edges(mesh)) {
    if (edge.triangles == 2) continue;
    for (const std::uint32_t v : edge.vertices) on_boundary[v] = true;
  }
  return on_boundary;
}

Adjacency boundary_neighbours(const TriangleMesh& mesh) {
  const std::vector<Edge> all = edges(mesh);
  return distinct(rows_from(mesh.positions.size(), [&](auto&& emit) {
    for (const Edge& edge : all) {
      if (edge.triangles == 2) continue;
      emit(edge.vertices[0], edge.vertices[1]);
      emit(edge.vertices[1], edge.vertices[0]);
    }
  }));
}

}  // namespace burnish
