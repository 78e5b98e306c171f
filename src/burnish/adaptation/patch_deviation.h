#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "burnish/base/vec3.h"

namespace burnish {

/// How far two triangulations of one small patch of surface are apart, as a bound that holds both
/// ways (Bajaj and Schikore 1998). Along one direction both cover the same part of a plane once;
/// laid over each other there, the distance between them is linear in every piece, and therefore
/// largest at a vertex of one inside the other or where two edges cross. Computed in double: it
/// holds up to the rounding of that.
class PatchDeviation {
 public:
  using Corners = std::array<std::uint32_t, 3>;

  /// Points that corners name from now on.
  std::vector<Vec3d> points;
  /// A patch: its triangles, and the points that do not lie on the outline that both have.
  struct Patch {
    std::vector<Corners> triangles;
    std::vector<std::uint32_t> inner;
  };
  Patch before, after;
  /// For each triangle of `before`, how far the true surface may be from it, m.
  std::vector<double> errors_before;

  /// Per triangle of `after` the same: what it was where it lies over `before`, and the distance
  /// between the two there. Where no direction shows both without a fold, the largest of what it
  /// was and the longest edge: no place of a patch is farther than that from a vertex of the
  /// outline, which is in both. O(#before #after).
  std::span<const double> errors_after();

 private:
  struct Point {
    double x, y, height;
  };
  struct InnerEdge {
    std::uint32_t from, to;
    std::array<std::uint32_t, 2> triangles;
  };

  bool lay_over();
  bool project();
  bool goes_round_once(const Patch& patch) const;
  void find_inner_edges(const Patch& patch, std::vector<InnerEdge>& edges) const;
  void meet(std::uint32_t triangle_after, std::uint32_t triangle_before, double distance);
  void meet_along_outline();
  void meet_at_crossings();
  bool meet_at_inner_points();
  double longest_edge() const;

  std::vector<Point> flat_;
  std::vector<InnerEdge> edges_before_, edges_after_;
  std::vector<double> distances_, inherited_, sums_;
};

}  // namespace burnish
