#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// The corners at each vertex as lists, the latest first. Corner 3 t + k is the k-th of triangle t.
class CornerStars {
 public:
  static constexpr std::uint32_t kEnd = ~0u;

  void reserve(std::size_t vertices, std::size_t triangles);
  void add_vertex() { first_.push_back(kEnd); }
  /// The corners of the next triangle; vertices must have been added.
  void add_triangle(const Triangle& triangle);

  std::uint32_t first(std::uint32_t vertex) const { return first_[vertex]; }
  std::uint32_t next(std::uint32_t corner) const { return next_[corner]; }

  /// Takes `corner` off the list of `vertex`, which has it. O(valence).
  void take(std::uint32_t vertex, std::uint32_t corner);
  /// Puts a corner that is on no list at the head of that of `vertex`.
  void put(std::uint32_t vertex, std::uint32_t corner) {
    next_[corner] = first_[vertex];
    first_[vertex] = corner;
  }
  /// Takes those whose `moves` is set, in the order of the list, over to the empty list of `to`.
  void move(std::uint32_t from, std::uint32_t to, std::span<const std::uint8_t> moves);

 private:
  std::vector<std::uint32_t> first_, next_;
};

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
class GrowingMesh {
 public:
  void reserve(std::size_t vertices, std::size_t triangles);
  void add_vertex(std::uint32_t index);
  void add_triangle(const Triangle& triangle, std::uint32_t index);

  /// O(valence of `into`). What the split names must be there; its apexes are not `into`.
  void split(const VertexSplit& split);

  std::size_t vertices() const { return vertex_indices_.size(); }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  const CornerStars& stars() const { return stars_; }
  std::uint32_t vertex_index(std::uint32_t v) const { return vertex_indices_[v]; }
  std::uint32_t triangle_index(std::uint32_t t) const { return triangle_indices_[t]; }

  /// What is left of it once it is grown up.
  struct Parts {
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> vertex_indices, triangle_indices;
  };
  Parts parts() &&;

 private:
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> vertex_indices_, triangle_indices_;
  CornerStars stars_;
};

}  // namespace burnish
