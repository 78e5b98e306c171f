#pragma once

#include <vector>

#include "burnish/core/point_cloud.h"
#include "burnish/triangulation/triangulation.h"

namespace burnish {

/// The points of a cloud that a mesh takes over, in their order.
struct UsedPoints {
  std::vector<std::uint32_t> points;  ///< their numbers in the cloud
  std::vector<std::uint32_t> number;  ///< of each used point of the cloud in the mesh

  /// Appends point `p`, larger than those that are there; `number` has room for it.
  void add(std::uint32_t p) {
    number[p] = static_cast<std::uint32_t>(points.size());
    points.push_back(p);
  }
};

/// The mesh of the points `used` and of `triangles`, which name them by their new numbers;
/// attributes are carried. Fills in all of the report but duplicate points and invented triangles.
/// O(#P + #T).
Triangulation mesh_of(const PointCloud& cloud, const UsedPoints& used,
                      std::vector<Triangle> triangles);

/// The mesh of `triangles`, which name points of `cloud`: points that no triangle uses are left
/// out. As above.
Triangulation mesh_of_used_points(const PointCloud& cloud, std::vector<Triangle> triangles);

}  // namespace burnish
