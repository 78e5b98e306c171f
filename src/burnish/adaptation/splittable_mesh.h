#pragma once

#include <span>
#include <vector>

#include "burnish/adaptation/interpolation.h"
#include "burnish/core/edge_table.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// The positions and triangles of a mesh whose edges can be split one after another, with the
/// triangles along them. Any mesh: an edge may have any number of triangles.
class SplittableMesh {
 public:
  /// `edges` are those of `mesh`, and keep their numbers.
  SplittableMesh(const TriangleMesh& mesh, const EdgeTable& edges);

  const std::vector<Vec3f>& positions() const { return positions_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  std::array<std::uint32_t, 2> ends(std::uint32_t edge) const { return ends_[edge]; }
  double squared_length(std::uint32_t edge) const;

  /// The longest of `edge` and the other edges of its triangles, of equal ones that with the
  /// smallest number.
  std::uint32_t longest_beside(std::uint32_t edge) const;

  /// Puts a vertex at `place` on an edge: the edge keeps its number and one of its ends. Each
  /// triangle along it becomes two, which keep its orientation; the one with the edge's first end
  /// keeps its number. Gives the edges that are new or another, until the next call. O(triangles
  /// along the edge and along the edges of those).
  std::span<const std::uint32_t> split(std::uint32_t edge, const Vec3f& place);

  /// Of the vertices that splits have made.
  const std::vector<Parents<2>>& parents() const { return parents_; }
  /// Per triangle the one of the mesh at first that it is part of.
  const std::vector<std::uint32_t>& origins() const { return origins_; }

 private:
  std::uint32_t add_edge(std::uint32_t a, std::uint32_t b);
  void join(std::uint32_t edge, std::uint32_t side);
  void replace(std::uint32_t edge, std::uint32_t side, std::uint32_t by);
  void collect_triangles(std::uint32_t edge);
  void split_triangle(std::uint32_t t, std::uint32_t median);

  /// What is split: edge ab by vertex m into edge am, which keeps the number, and mb.
  struct Halves {
    std::uint32_t edge, other, a, b, m;
  };
  struct Wing {
    std::uint32_t corner, triangle;  ///< a triangle along the edge, and its third corner
  };

  std::vector<Vec3f> positions_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> origins_;
  std::vector<Parents<2>> parents_;
  std::vector<std::array<std::uint32_t, 2>> ends_;  ///< per edge
  std::vector<std::uint32_t> first_;                ///< per edge its first side
  std::vector<std::uint32_t> next_;                 ///< per side the next one of its edge
  std::vector<std::uint32_t> edge_;                 ///< per side
  Halves halves_{};
  std::vector<Wing> wings_;
  std::vector<std::uint32_t> changed_;
};

}  // namespace burnish
