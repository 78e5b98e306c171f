#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// A surface under construction that is edge-manifold and of one orientation after every insertion.
/// The link of a vertex (the edges opposite to it in its triangles) is a set of paths, or one
/// cycle.
class ManifoldSurface {
 public:
  /// Two ends of the link of `vertex` with nothing between them, seen from outside: the boundary
  /// comes from `from` and leaves to `to`, with the gap on its left.
  struct Corner {
    std::uint32_t vertex, from, to;
  };

  ManifoldSurface(std::span<const Vec3f> positions, std::span<const Vec3f> normals);

  /// Adds `t` without asking; the caller knows that it fits.
  void add(const Triangle& t);

  /// Adds `t` where the three directed edges are free, where at no corner it lies over triangles
  /// that are there (seen along the corner's normal), and where every link stays a set of paths or
  /// one cycle. O(valence).
  bool add_if_manifold(const Triangle& t);

  void remove(std::uint32_t triangle);

  /// Whether some triangle has the edge from a to b in this direction.
  bool has_edge(std::uint32_t a, std::uint32_t b) const { return successor(a, b) != kNone; }

  /// The gaps around `v`, by angle where there are several; none for an inner or unused vertex.
  void corners(std::uint32_t v, std::vector<Corner>& found) const;

  /// The triangles of `v`, path by path of its link, longest first (of equally long ones that which
  /// holds the smallest index); more than one path: the surface is pinched at `v`.
  void paths(std::uint32_t v, std::vector<std::vector<std::uint32_t>>& found) const;

  /// The triangles that were not removed, in the order of insertion.
  std::vector<Triangle> triangles() const;
  std::size_t vertex_count() const { return first_corner_.size(); }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  /// A corner of triangle number / 3; the corners of a vertex are a linked list.
  struct LinkEdge {
    std::uint32_t corner, begin, end;
  };
  template <class Visit>
  void for_each_link_edge(std::uint32_t v, Visit visit) const;
  std::uint32_t successor(std::uint32_t v, std::uint32_t w) const;
  bool fits(std::uint32_t v, std::uint32_t begin, std::uint32_t end) const;
  /// Positive where w2 is less than half a turn counter-clockwise from w1 around v.
  double turn(std::uint32_t v, std::uint32_t w1, std::uint32_t w2) const;

  std::span<const Vec3f> positions_, normals_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> first_corner_, next_corner_;
};

}  // namespace burnish
