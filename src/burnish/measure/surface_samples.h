#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// A point on a mesh, in the coordinates of `mesh.positions`.
struct SurfaceSample {
  Vec3d point;
  std::uint32_t triangle;  ///< that holds it
};

/// One point in each of `count` equal parts of the surface, laid triangle after triangle: every
/// triangle gets its share by area. The same points at every call with the same seed. `mesh` must
/// pass check_surface. O(#T + count log #T).
std::vector<SurfaceSample> surface_samples(const TriangleMesh& mesh, std::size_t count,
                                           std::uint64_t seed = 1);

/// The area of all triangles, m2.
double surface_area(const TriangleMesh& mesh);

/// Whether the mesh can be measured against: sound, and not without area. Errors: bad_geometry,
/// with `name` as its place.
Result<void> check_surface(const TriangleMesh& mesh, std::string_view name);

}  // namespace burnish
