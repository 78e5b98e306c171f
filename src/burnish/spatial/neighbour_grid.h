#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/vec3.h"
#include "burnish/spatial/neighbour_lists.h"

namespace burnish {

/// A point that a query found.
struct Neighbour {
  std::uint32_t index;
  double squared_distance;

  friend bool operator==(const Neighbour&, const Neighbour&) = default;
};

/// Nearest-neighbour queries by cells. The points are sorted by cell, so that a row of cells is one
/// run of memory; a crowded cell is a smaller grid over the box of its own points, so that cells
/// follow the density wherever it changes, and coincident points end in a cell of their own.
///
/// Distances are computed in double from the float coordinates; results rise by (distance, index)
/// and depend on nothing else. Points that are not finite are never found. Queries may run at the
/// same time on many threads. Building: O(#P) for evenly sampled surfaces; 20 bytes a point and
/// a few more for the cells. A query for k neighbours: O(k) where the sampling changes slowly.
class NeighbourGrid {
 public:
  /// The points are copied.
  explicit NeighbourGrid(std::span<const Vec3f> points);

  /// The `count` points nearest to `query`, the query itself among them where it is one of the
  /// points; all points where there are fewer; none where the query is not finite.
  void nearest(const Vec3f& query, std::size_t count, std::vector<Neighbour>& found) const;

  /// The points at most `radius` away, the distance itself included.
  void within(const Vec3f& query, double radius, std::vector<Neighbour>& found) const;

  /// The `count` nearest of every point (all where there are fewer), as nearest() gives them; for
  /// points that are all finite. Faster than as many queries: points of one place look for theirs
  /// together. Returns false where cancelled. O(#P count) where the sampling changes slowly.
  [[nodiscard]] bool nearest_of_all(std::size_t count, const Context& context,
                                    NeighbourLists& lists) const;

  /// How many points can be found.
  std::size_t size() const { return points_.size(); }

 private:
  struct Point {
    Vec3f position;
    std::uint32_t index;
  };
  /// A box of cubic cells. Cell (x, y, z) is number (z * ny + y) * nx + x.
  struct Node {
    Vec3d low;
    double cell = 1, inverse_cell = 1;
    std::array<std::int32_t, 3> size{1, 1, 1};
    std::uint32_t first_start = 0;  ///< into starts_: one entry more than there are cells
    std::int64_t first_child = -1;  ///< into children_; -1: no cell is a grid of its own
    double area_per_point = 0;
    bool coincident = false;  ///< all its points are the same
  };
  struct Search;
  class Gathered;

  std::uint32_t build(std::uint32_t begin, std::uint32_t end);
  void sort_into_cells(const Node& node, std::uint32_t begin, std::uint32_t end);
  template <class Query>
  void visit(std::uint32_t node, Query& query) const;
  template <class Query>
  void scan(std::uint32_t begin, std::uint32_t end, Query& query) const;
  void nearest_of_group(const Point* begin, const Point* end, std::size_t count, double& radius,
                        Gathered& gathered, std::vector<Neighbour>& found,
                        std::vector<std::uint32_t>& rows) const;
  double first_radius(const Vec3d& query, std::size_t count) const;
  double area_per_point_near(const Vec3d& query) const;

  std::vector<Point> points_;            ///< in the order of the cells
  std::vector<Node> nodes_;              ///< nodes_[0] is the root
  std::vector<std::uint32_t> starts_;    ///< where each cell's points begin in points_
  std::vector<std::uint32_t> children_;  ///< node of each cell, kLeaf where it is none
  std::vector<Point> sorted_;            ///< scratch of the building
};

}  // namespace burnish
