#pragma once

#include <span>

#include "burnish/triangulation/plane_subdivision.h"
#include "burnish/triangulation/predicates.h"

namespace burnish {

/// The Delaunay triangulation of some points, held by an edge of its convex hull that has the
/// outside on its right; a single point has no edge.
struct HullPart {
  std::uint32_t point;
  std::uint32_t hull = kNoEdge;
};

/// The line between two parts.
enum class Cut { upright, level };

/// Merges Delaunay triangulations that a line parts (Guibas and Stolfi 1985, section 9). New edges
/// take the slots of `slots`, front to back.
class HullMerger {
 public:
  HullMerger(std::span<const Vec2d> points, PlaneSubdivision& edges, std::span<EdgeSlots> slots)
      : points_(points), edges_(edges), slots_(slots) {}

  /// The triangulation of two points.
  HullPart join(std::uint32_t a, std::uint32_t b);

  /// `left` is left of an upright cut or below a level one; points on the cut itself are parted by
  /// y or by -x. O(edges made and removed + edges of the hulls).
  HullPart merge(const HullPart& left, const HullPart& right, Cut cut);

 private:
  /// An edge between a base's end and a point above the base.
  struct Candidate {
    std::uint32_t edge, apex;
    bool above;
  };

  const Vec2d& at(std::uint32_t point) const { return points_[point]; }
  std::uint32_t add_edge(std::uint32_t from, std::uint32_t to);
  void remove_edge(std::uint32_t e);
  template <class Beyond>
  std::uint32_t extreme(std::uint32_t e, Beyond beyond) const;
  std::uint32_t lower_tangent(const HullPart& left, const HullPart& right, Cut cut);
  template <class Turn>
  Candidate clear(std::uint32_t base, std::uint32_t from, Turn turn);
  std::uint32_t rise(std::uint32_t base);

  std::span<const Vec2d> points_;
  PlaneSubdivision& edges_;
  std::span<EdgeSlots> slots_;
};

}  // namespace burnish
