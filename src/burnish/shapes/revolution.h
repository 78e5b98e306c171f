#pragma once

#include <vector>

#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// A point of the half plane that turns around the z axis.
struct ProfilePoint {
  double radius, z;
};

/// The surface that `profile` sweeps in `segments` steps around the z axis. A point of radius 0
/// gives one vertex. Outside lies to the right of the profile's direction, seen with z upwards and
/// the radius to the right. `closed` joins the last point to the first.
TriangleMesh revolve(const std::vector<ProfilePoint>& profile, bool closed, int segments);

}  // namespace burnish
