#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "burnish/pipeline/triangle_stars.h"

namespace burnish {

/// A triangle that comes back with a vertex split: its corners are the vertex that was split, the
/// new one and an apex.
struct ReturningTriangle {
  std::uint32_t apex = 0;
  std::uint8_t order = 0;   ///< which of them is which corner: a row of kCornerOrders
  std::uint32_t index = 0;  ///< in the original mesh
  Origin origin = Origin::seen;
  std::uint32_t owner = 0;  ///< a vertex of the original mesh
};

/// What each corner is: 0 the vertex that was split, 1 the new vertex, 2 the apex.
inline constexpr std::array<std::array<std::uint8_t, 3>, 6> kCornerOrders{
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};

/// A Removal undone, told to a mesh that only knows the vertices and triangles that it has.
struct VertexSplit {
  std::uint32_t into = 0;           ///< the vertex to split
  std::uint32_t index = 0;          ///< of the new vertex in the original mesh
  float error = 0;                  ///< of the mesh after the split, m
  std::vector<std::uint8_t> moves;  ///< per corner at `into`, the latest first: 1 = to the new one
  std::array<ReturningTriangle, 2> returning{};
  std::size_t returning_count = 0;
};

/// The triangles of a mesh that grows by vertex splits. Vertices and triangles are numbered in the
/// order in which they came; which ones of the original they are is carried along.
struct GrowingMesh {
  TriangleStars stars;
  std::vector<std::uint32_t> vertex_indices, triangle_indices;  ///< in the original

  void reserve(std::size_t vertices, std::size_t triangles);
  void add_vertex(std::uint32_t index);
  void add_triangle(const Triangle& triangle, std::uint32_t index);

  /// O(valence of `into`). What the split names must be there; its apexes are not `into`.
  void split(const VertexSplit& split);
};

}  // namespace burnish
