#pragma once

#include <cstdint>
#include <vector>

namespace burnish {

/// A point of a tangent plane whose origin is the star's centre; never the origin itself.
struct PlanePoint {
  double x, y;
  std::uint32_t index;  ///< breaks ties
};

/// The star of the origin in the Delaunay triangulation of itself and some points. Inversion in the
/// unit circle turns circles through the origin into lines, and the star's rim into the convex hull
/// of the inverted points.
class DelaunayStar {
 public:
  /// `centre` is the origin's own index. Cocircular points are triangulated from the one with the
  /// smallest index; of points in one direction the nearest counts. O(#P log #P).
  void build(const std::vector<PlanePoint>& points, std::uint32_t centre);

  /// Numbers of the rim's points, counter-clockwise.
  const std::vector<std::uint32_t>& rim() const { return rim_; }
  /// Whether the last point of the rim is joined to the first; otherwise the origin is on the hull.
  bool closed() const { return closed_; }
  /// Diameter, squared, of the largest circle through the origin and two successive points.
  double squared_diameter() const { return squared_diameter_; }

 private:
  struct Ray {
    double direction;  ///< rises with the polar angle, from 0 to 4
    std::uint32_t number, index;
  };
  struct Inverted {
    double x, y;
    double squared_norm;
    std::uint32_t number, index;
  };
  void sort_around(const std::vector<PlanePoint>& points);
  void invert(const std::vector<PlanePoint>& points);
  std::size_t find_start();
  void walk_around_hull(std::size_t start);
  void settle_circles(std::uint32_t centre);
  void measure();

  std::vector<Ray> rays_;
  std::vector<Inverted> around_, hull_;
  std::vector<std::uint32_t> rim_;
  bool closed_ = false;
  double squared_diameter_ = 0;
};

}  // namespace burnish
