#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// An undirected edge and what uses it.
struct Edge {
  std::array<std::uint32_t, 2> vertices;  ///< the smaller index first
  std::uint32_t triangles = 0;            ///< how many triangles use it
  std::uint32_t forward = 0;              ///< how many of them run from vertices[0] to vertices[1]

  bool manifold() const { return triangles <= 2; }
  bool boundary() const { return triangles == 1; }
  /// Two triangles that run along it the same way: their orientations disagree.
  bool flipped() const { return triangles == 2 && forward != 1; }
};

/// Every edge of the mesh once, by (smaller, larger) vertex index; edges from a vertex to itself
/// are left out. O(#T log valence).
std::vector<Edge> edges(const TriangleMesh& mesh);

/// Of all distinct edges, m; 0 where there are none.
double mean_edge_length(const TriangleMesh& mesh);

}  // namespace burnish
