#pragma once

#include <vector>

#include "burnish/core/point_cloud.h"
#include "burnish/triangulation/triangulation.h"

namespace burnish {

/// The mesh of `triangles`, which name points of `cloud`: points that no triangle uses are left
/// out, the others keep their order and their attributes. Fills in all of the report but
/// duplicate points and invented triangles. O(#P + #T).
Triangulation mesh_of_used_points(const PointCloud& cloud, std::vector<Triangle> triangles);

}  // namespace burnish
