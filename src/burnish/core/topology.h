#pragma once

#include <cstdint>
#include <vector>

#include "burnish/base/facts.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// How a mesh hangs together. Vertices that no triangle uses are counted apart and nowhere else.
struct Topology {
  std::size_t edges = 0;
  std::size_t boundary_edges = 0;         ///< with one triangle
  std::size_t non_manifold_edges = 0;     ///< with three or more
  std::size_t flipped_edges = 0;          ///< whose two triangles disagree on the orientation
  std::size_t non_manifold_vertices = 0;  ///< whose triangles form more than one fan
  std::size_t boundary_loops = 0;         ///< chains of boundary edges, counted by connectivity
  std::size_t components = 0;             ///< sets of triangles joined across edges
  std::size_t degenerate_triangles = 0;   ///< that name a vertex twice
  std::size_t duplicate_triangles = 0;    ///< with the same three vertices as an earlier one
  std::size_t unused_vertices = 0;
  std::int64_t euler_number = 0;  ///< used vertices - edges + triangles

  bool edge_manifold() const { return non_manifold_edges == 0; }
  bool oriented() const { return non_manifold_edges == 0 && flipped_edges == 0; }
  bool closed() const { return boundary_edges == 0; }

  Facts facts() const;
};

/// O(#V + #T log valence).
Topology topology(const TriangleMesh& mesh);

/// Per triangle the number of its component (0, 1, ... in the order of their first triangles);
/// triangles are joined where they share an edge.
std::vector<std::uint32_t> triangle_components(const TriangleMesh& mesh);

}  // namespace burnish
