#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "burnish/core/triangle_mesh.h"
#include "burnish/triangulation/predicates.h"

namespace burnish::test {

__extension__ using Wide = __int128;

/// A point whose coordinates are whole numbers below 2^28, so that everything here is exact.
struct LatticePoint {
  std::int64_t x, y;
  friend auto operator<=>(const LatticePoint&, const LatticePoint&) = default;
};

inline Wide doubled_area(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
  return Wide{a.x - c.x} * (b.y - c.y) - Wide{a.y - c.y} * (b.x - c.x);
}

/// Positive where d is inside the circle through a, b, c, which are counter-clockwise.
inline Wide side_of_circle(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c,
                           const LatticePoint& d) {
  const auto lift = [&](const LatticePoint& p) {
    return Wide{p.x - d.x} * (p.x - d.x) + Wide{p.y - d.y} * (p.y - d.y);
  };
  return lift(a) * doubled_area(b, c, d) + lift(b) * doubled_area(c, a, d) +
         lift(c) * doubled_area(a, b, d);
}

/// The doubled area of the convex hull of sorted points (Andrew's monotone chain).
inline Wide doubled_hull_area(const std::vector<LatticePoint>& sorted) {
  Wide area = 0;
  for (const bool upper : {false, true}) {
    std::vector<LatticePoint> chain;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      const LatticePoint& p = sorted[upper ? sorted.size() - 1 - i : i];
      while (chain.size() > 1 && doubled_area(chain[chain.size() - 2], chain.back(), p) <= 0)
        chain.pop_back();
      chain.push_back(p);
    }
    for (std::size_t i = 1; i < chain.size(); ++i)
      area += doubled_area(sorted.front(), chain[i - 1], chain[i]);
  }
  return area;
}

/// Empty where `triangles` are a Delaunay triangulation of all the points, which are distinct: all
/// counter-clockwise, every edge with one triangle on a side and no vertex across it inside of the
/// circle, together as large as the convex hull, all points used; otherwise what is wrong.
inline std::string delaunay_defect(const std::vector<LatticePoint>& points,
                                   const std::vector<Triangle>& triangles) {
  std::vector<LatticePoint> sorted = points;
  std::sort(sorted.begin(), sorted.end());
  const Wide hull = sorted.empty() ? 0 : doubled_hull_area(sorted);
  Wide area = 0;
  std::vector<bool> used(points.size());
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> apex;  // on the left of a directed edge
  for (const Triangle& t : triangles) {
    const Wide own = doubled_area(points[t[0]], points[t[1]], points[t[2]]);
    if (own <= 0) return "a triangle is not counter-clockwise";
    area += own;
    for (std::size_t k = 0; k < 3; ++k) {
      used[t[k]] = true;
      if (!apex.insert({{t[k], t[(k + 1) % 3]}, t[(k + 2) % 3]}).second)
        return "an edge is used twice";
    }
  }
  if (area != hull) return "the triangles do not cover the convex hull";
  if (hull > 0 && !std::all_of(used.begin(), used.end(), [](bool u) { return u; }))
    return "a point is not used";
  for (const auto& [edge, own] : apex) {
    const auto across = apex.find({edge[1], edge[0]});
    if (across != apex.end() &&
        side_of_circle(points[edge[0]], points[edge[1]], points[own], points[across->second]) > 0)
      return "an edge is not Delaunay";
  }
  return {};
}

/// The triangles by the coordinates of their corners, in an order that depends on nothing else.
inline std::vector<std::array<double, 6>> soup(std::span<const Vec2d> points,
                                               const std::vector<Triangle>& triangles) {
  std::vector<std::array<double, 6>> result;
  for (Triangle t : triangles) {
    std::rotate(t.begin(),
                std::min_element(t.begin(), t.end(),
                                 [&](std::uint32_t a, std::uint32_t b) {
                                   return lexicographically_less(points[a], points[b]);
                                 }),
                t.end());
    result.push_back({points[t[0]].x, points[t[0]].y, points[t[1]].x, points[t[1]].y,
                      points[t[2]].x, points[t[2]].y});
  }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace burnish::test
