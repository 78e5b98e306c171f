#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "burnish/adaptation/loop.h"
#include "burnish/adaptation/midpoint.h"
#include "burnish/adaptation/split.h"
#include "burnish/adaptation/sqrt3.h"
#include "burnish/core/topology.h"

// What every refinement promises of its result.
namespace burnish::test {

/// A refinement by name.
struct Refinement {
  std::string name;
  std::function<Result<RefinementReport>(TriangleMesh&, const Context&)> run;
};

inline std::vector<Refinement> refinements(double max_chord = 0.002) {
  return {
      {"loop", [](TriangleMesh& m, const Context& c) { return refine_loop(m, {}, c); }},
      {"loop twice", [](TriangleMesh& m, const Context& c) { return refine_loop(m, {2}, c); }},
      {"sqrt3", [](TriangleMesh& m, const Context& c) { return refine_sqrt3(m, {}, c); }},
      {"sqrt3 twice", [](TriangleMesh& m, const Context& c) { return refine_sqrt3(m, {2}, c); }},
      {"midpoint", [](TriangleMesh& m, const Context& c) { return refine_midpoint(m, {}, c); }},
      {"midpoint twice",
       [](TriangleMesh& m, const Context& c) { return refine_midpoint(m, {2}, c); }},
      {"split", [](TriangleMesh& m, const Context& c) { return refine_split(m, {}, c); }},
      {"split by chord", [max_chord](TriangleMesh& m, const Context& c) {
         return refine_split(m, {.max_chord = max_chord}, c);
       }}};
}

inline TriangleMesh refined(TriangleMesh mesh, const Refinement& method) {
  const auto report = method.run(mesh, {});
  EXPECT_TRUE(report) << method.name << ": " << (report ? "" : report.error().text());
  return mesh;
}

inline TriangleMesh with_zone(TriangleMesh mesh, std::vector<float> weights) {
  mesh.attributes.channels.push_back({std::string(kRefinement), std::move(weights)});
  return mesh;
}

/// The sides of triangles along each edge.
inline std::map<std::array<std::uint32_t, 2>, int> sides_along_edges(const TriangleMesh& mesh) {
  std::map<std::array<std::uint32_t, 2>, int> sides;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(t[i], t[(i + 1) % 3]);
      if (low != high) ++sides[{low, high}];
    }
  }
  return sides;
}

/// Per vertex how many edges at it have an odd number of sides.
inline std::vector<int> rim_edges(const TriangleMesh& mesh) {
  std::vector<int> count(mesh.positions.size(), 0);
  for (const auto& [edge, sides] : sides_along_edges(mesh)) {
    if (sides % 2 == 0) continue;
    ++count[edge[0]];
    ++count[edge[1]];
  }
  return count;
}

/// An edge that was there is there for all triangles along it, or for none: one that is cut for
/// some of them alone would be a crack. And what the triangles' sides leave open together is the
/// same, but for vertices put on it.
inline void expect_no_cracks(const TriangleMesh& before, const TriangleMesh& after) {
  const auto left = sides_along_edges(after);
  for (const auto& [edge, sides] : sides_along_edges(before)) {
    const auto found = left.find(edge);
    if (found != left.end()) {
      EXPECT_EQ(found->second, sides) << edge[0] << " " << edge[1];
    }
  }
  const std::vector<int> old_rim = rim_edges(before), rim = rim_edges(after);
  for (std::size_t v = 0; v < rim.size(); ++v) {
    if (v < old_rim.size()) {
      EXPECT_EQ(rim[v], old_rim[v]) << v;
    } else {
      EXPECT_TRUE(rim[v] == 0 || rim[v] == 2) << v;
    }
  }
}

/// The same kind of surface. On a closed one that leaves no room for cracks.
inline void expect_same_topology(const TriangleMesh& before, const TriangleMesh& after) {
  const Topology a = topology(before), b = topology(after);
  EXPECT_EQ(b.euler_number, a.euler_number);
  EXPECT_EQ(b.components, a.components);
  EXPECT_EQ(b.boundary_loops, a.boundary_loops);
  EXPECT_EQ(b.boundary_edges == 0, a.boundary_edges == 0);
  EXPECT_EQ(b.non_manifold_edges, a.non_manifold_edges);
  EXPECT_EQ(b.non_manifold_vertices, a.non_manifold_vertices);
  EXPECT_EQ(b.flipped_edges == 0, a.flipped_edges == 0);
  EXPECT_EQ(b.unused_vertices, a.unused_vertices);
  EXPECT_EQ(b.degenerate_triangles, a.degenerate_triangles);
  EXPECT_EQ(b.duplicate_triangles, a.duplicate_triangles);
}

}  // namespace burnish::test
