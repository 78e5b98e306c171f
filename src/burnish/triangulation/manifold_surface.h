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
  void add(const Triangle& t, Origin origin = Origin::seen);

  /// Adds `t` where its three directed edges are free and every link stays a set of paths or one
  /// cycle. O(valence).
  bool add_if_manifold(const Triangle& t, Origin origin = Origin::seen);

  /// Whether `t` folds back at a corner or lies over a triangle that is there, seen along the
  /// corner's normal. O(valence).
  bool overlaps(const Triangle& t) const;

  /// Whether an edge of `t` is one of a triangle on its other side. O(valence).
  bool touches(const Triangle& t) const {
    return has_edge(t[1], t[0]) || has_edge(t[2], t[1]) || has_edge(t[0], t[2]);
  }

  /// Whether `v` is a corner of a triangle.
  bool uses(std::uint32_t v) const { return first_corner_[v] != kNone; }

  /// Whether more than `count` vertices hang together with `v`, itself among them. O(count).
  bool is_larger(std::uint32_t v, std::size_t count) const;

  void remove(std::uint32_t triangle);

  /// Removes all triangles that hang together with `v`.
  void remove_piece(std::uint32_t v);

  /// Whether some triangle has the edge from a to b in this direction.
  bool has_edge(std::uint32_t a, std::uint32_t b) const { return successor(a, b) != kNone; }

  /// The gaps around all vertices, vertex by vertex; none for inner and unused vertices. O(#V) the
  /// first time, then of what had gaps or was changed since.
  std::vector<Corner> corners();

  /// The triangles of each path of the link of `v`, from its beginning; the longest path first, of
  /// equally long ones that which begins with the smallest index. For a vertex that has corners.
  void paths(std::uint32_t v, std::vector<std::vector<std::uint32_t>>& found) const;

  /// The triangles that were not removed, in the order of insertion, and where each comes from.
  void triangles(std::vector<Triangle>& kept, std::vector<Origin>& origin) const;
  std::size_t vertex_count() const { return first_corner_.size(); }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  /// A corner of triangle number / 3; the corners of a vertex are a linked list.
  struct LinkEdge {
    std::uint32_t corner, begin, end;
  };
  void suspect(const Triangle& t);
  bool is_inner(std::uint32_t v) const;
  template <class Visit>
  void for_each_link_edge(std::uint32_t v, Visit visit) const;
  std::uint32_t successor(std::uint32_t v, std::uint32_t w) const;
  void ends(std::uint32_t v, std::vector<std::uint32_t>& begins,
            std::vector<std::uint32_t>& ends) const;
  bool fits(std::uint32_t v, std::uint32_t begin, std::uint32_t end) const;
  bool overlaps_at(std::uint32_t v, std::uint32_t begin, std::uint32_t end) const;
  /// Positive where w2 is less than half a turn counter-clockwise from w1 around v.
  double turn(std::uint32_t v, std::uint32_t w1, std::uint32_t w2) const;

  std::span<const Vec3f> positions_, normals_;
  std::vector<Triangle> triangles_;
  std::vector<Origin> origin_;
  std::vector<std::uint32_t> first_corner_, next_corner_;
  std::vector<std::uint32_t> suspects_;  ///< all others have no gap; from the first corners() on
  bool watching_ = false;
};

}  // namespace burnish
