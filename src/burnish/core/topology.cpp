#include "burnish/core/topology.h"

#include <algorithm>

#include "burnish/core/adjacency.h"
#include "burnish/core/disjoint_sets.h"
#include "burnish/core/edges.h"

namespace burnish {
namespace {

/// Triangles that share an edge, in one set. Their sides are bucketed by the smaller vertex; each
/// bucket is then small enough to sort.
DisjointSets joined_across_edges(const TriangleMesh& mesh) {
  struct Side {
    std::uint32_t high, triangle;
  };
  std::vector<std::uint32_t> starts(mesh.positions.size() + 1, 0);
  const auto for_each_side = [&](auto&& visit) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = mesh.triangles[t][i], b = mesh.triangles[t][(i + 1) % 3];
        if (a != b) visit(std::min(a, b), Side{std::max(a, b), t});
      }
    }
  };
  for_each_side([&](std::uint32_t low, const Side&) { ++starts[low + 1]; });
  for (std::size_t v = 1; v < starts.size(); ++v) starts[v] += starts[v - 1];
  std::vector<Side> sides(starts.back());
  std::vector<std::uint32_t> next(starts.begin(), starts.end() - 1);
  for_each_side([&](std::uint32_t low, const Side& side) { sides[next[low]++] = side; });

  DisjointSets sets(mesh.triangles.size());
  for (std::size_t low = 0; low + 1 < starts.size(); ++low) {
    const auto begin = sides.begin() + starts[low], end = sides.begin() + starts[low + 1];
    std::sort(begin, end, [](const Side& a, const Side& b) { return a.high < b.high; });
    for (auto it = begin; it != end; ++it) {
      if (it != begin && it->high == (it - 1)->high) sets.unite(it->triangle, (it - 1)->triangle);
    }
  }
  return sets;
}

bool names_twice(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

std::size_t count_duplicates(const TriangleMesh& mesh) {
  std::vector<Triangle> sorted = mesh.triangles;
  for (Triangle& t : sorted) std::sort(t.begin(), t.end());
  std::sort(sorted.begin(), sorted.end());
  return static_cast<std::size_t>(sorted.end() - std::unique(sorted.begin(), sorted.end()));
}

/// Whether the triangles around `v` hang together by edges at `v`; degenerate ones are left out.
bool is_one_fan(const TriangleMesh& mesh, std::uint32_t v, std::span<const std::uint32_t> around) {
  struct Spoke {
    std::uint32_t end, triangle;
  };
  std::vector<Spoke> spokes;
  std::uint32_t triangles = 0;
  for (const std::uint32_t t : around) {
    if (names_twice(mesh.triangles[t])) continue;
    for (const std::uint32_t w : mesh.triangles[t]) {
      if (w != v) spokes.push_back({w, triangles});
    }
    ++triangles;
  }
  std::sort(spokes.begin(), spokes.end(),
            [](const Spoke& a, const Spoke& b) { return a.end < b.end; });
  DisjointSets fans(triangles);
  std::size_t count = triangles;
  for (std::size_t i = 1; i < spokes.size(); ++i) {
    if (spokes[i].end == spokes[i - 1].end) {
      count -= fans.unite(spokes[i].triangle, spokes[i - 1].triangle);
    }
  }
  return count <= 1;
}

std::size_t count_boundary_loops(const TriangleMesh& mesh, const std::vector<Edge>& all) {
  DisjointSets chains(mesh.positions.size());
  std::size_t loops = 0;
  std::vector<bool> on_boundary(mesh.positions.size(), false);
  for (const Edge& edge : all) {
    if (!edge.boundary()) continue;
    for (const std::uint32_t v : edge.vertices) {
      loops += !on_boundary[v];
      on_boundary[v] = true;
    }
    loops -= chains.unite(edge.vertices[0], edge.vertices[1]);
  }
  return loops;
}

}  // namespace

std::vector<std::uint32_t> triangle_components(const TriangleMesh& mesh) {
  DisjointSets sets = joined_across_edges(mesh);
  std::vector<std::uint32_t> number(mesh.triangles.size());
  std::uint32_t count = 0;
  for (std::uint32_t t = 0; t < number.size(); ++t) {
    const std::uint32_t first = sets.find(t);
    number[t] = first == t ? count++ : number[first];
  }
  return number;
}

Topology topology(const TriangleMesh& mesh) {
  Topology result;
  const std::vector<Edge> all = edges(mesh);
  result.edges = all.size();
  for (const Edge& edge : all) {
    result.boundary_edges += edge.boundary();
    result.non_manifold_edges += !edge.manifold();
    result.flipped_edges += edge.flipped();
  }
  result.boundary_loops = count_boundary_loops(mesh, all);
  for (const Triangle& t : mesh.triangles) result.degenerate_triangles += names_twice(t);
  result.duplicate_triangles = count_duplicates(mesh);

  const Adjacency around = triangles_of_vertices(mesh);
  std::size_t used = 0;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    used += !around.row(v).empty();
    result.non_manifold_vertices += !is_one_fan(mesh, v, around.row(v));
  }
  result.unused_vertices = mesh.positions.size() - used;
  result.euler_number = static_cast<std::int64_t>(used) - static_cast<std::int64_t>(all.size()) +
                        static_cast<std::int64_t>(mesh.triangles.size());
  for (const std::uint32_t c : triangle_components(mesh)) {
    result.components = std::max<std::size_t>(result.components, c + 1);
  }
  return result;
}

Facts Topology::facts() const {
  const auto count = [](std::string key, auto value) {
    return Fact{std::move(key), static_cast<double>(value), ""};
  };
  return {count("edges", edges),
          count("boundary_edges", boundary_edges),
          count("boundary_loops", boundary_loops),
          count("non_manifold_edges", non_manifold_edges),
          count("non_manifold_vertices", non_manifold_vertices),
          count("flipped_edges", flipped_edges),
          count("components", components),
          count("degenerate_triangles", degenerate_triangles),
          count("duplicate_triangles", duplicate_triangles),
          count("unused_vertices", unused_vertices),
          count("euler_number", euler_number)};
}

}  // namespace burnish
