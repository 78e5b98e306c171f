#include "burnish/core/edges.h"

#include <algorithm>

namespace burnish {

std::vector<Edge> edges(const TriangleMesh& mesh) {
  // Half-edges bucketed by their smaller vertex; each bucket is then small enough to sort.
  std::vector<std::uint32_t> starts(mesh.positions.size() + 1, 0);
  const auto for_each_half_edge = [&](auto&& visit) {
    for (const Triangle& t : mesh.triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = t[i], b = t[(i + 1) % 3];
        if (a != b) visit(std::min(a, b), std::max(a, b), a < b);
      }
    }
  };
  for_each_half_edge([&](std::uint32_t low, std::uint32_t, bool) { ++starts[low + 1]; });
  for (std::size_t v = 1; v < starts.size(); ++v) starts[v] += starts[v - 1];

  struct HalfEdge {
    std::uint32_t high;
    bool forward;
  };
  std::vector<HalfEdge> half_edges(starts.back());
  std::vector<std::uint32_t> next(starts.begin(), starts.end() - 1);
  for_each_half_edge([&](std::uint32_t low, std::uint32_t high, bool forward) {
    half_edges[next[low]++] = {high, forward};
  });

  std::vector<Edge> result;
  result.reserve(half_edges.size() / 2 + 1);
  for (std::uint32_t low = 0; low + 1 < starts.size(); ++low) {
    const auto begin = half_edges.begin() + starts[low], end = half_edges.begin() + starts[low + 1];
    std::sort(begin, end, [](const HalfEdge& a, const HalfEdge& b) { return a.high < b.high; });
    for (auto it = begin; it != end; ++it) {
      if (it == begin || it->high != (it - 1)->high) result.push_back({{low, it->high}});
      ++result.back().triangles;
      result.back().forward += it->forward;
    }
  }
  return result;
}

double mean_edge_length(const TriangleMesh& mesh) {
  const std::vector<Edge> all = edges(mesh);
  double sum = 0;
  for (const auto& [vertices, triangles, forward] : all) {
    sum += norm(Vec3d(mesh.positions[vertices[0]]) - Vec3d(mesh.positions[vertices[1]]));
  }
  return all.empty() ? 0 : sum / static_cast<double>(all.size());
}

}  // namespace burnish
