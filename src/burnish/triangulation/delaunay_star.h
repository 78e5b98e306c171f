#pragma once

#include <cstdint>
#include <vector>

namespace burnish {

/// A point of a tangent plane whose origin is the star's centre; never the origin itself.
struct PlanePoint {
  double x, y;
  std::uint32_t index;  ///< breaks ties
};

/// The star of the origin in the Delaunay triangulation of itself and some points.
class DelaunayStar {
 public:
  /// `centre` is the origin's own index. Cocircular points are triangulated from the one with the
  /// smallest index. O(#points * #rim).
  void build(const std::vector<PlanePoint>& points, std::uint32_t centre);

  /// Numbers of the rim's points, counter-clockwise.
  const std::vector<std::uint32_t>& rim() const { return rim_; }
  /// Whether the last point of the rim is joined to the first; otherwise the origin is on the hull.
  bool closed() const { return closed_; }
  /// Diameter, squared, of the largest circle through the origin and two successive points.
  double squared_diameter() const { return squared_diameter_; }

 private:
  enum class Turn { counter_clockwise, clockwise };
  void walk(const std::vector<PlanePoint>& points, std::uint32_t centre, Turn turn);
  std::uint32_t next(const std::vector<PlanePoint>& points, std::uint32_t from,
                     std::uint32_t centre, double sign);

  std::vector<std::uint32_t> rim_;
  std::vector<std::uint32_t> tied_;
  std::vector<bool> on_rim_;
  bool closed_ = false;
  double squared_diameter_ = 0;
};

}  // namespace burnish
