#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "burnish/base/random.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish::training {

/// A solid as a tree of simple ones: negative inside, of about unit gradient near its surface.
class Solid {
 public:
  struct Value {
    double f;       ///< 0 on the surface
    double crease;  ///< difference of the two surfaces that meet nearest by; 0 on a sharp edge
  };
  virtual ~Solid() = default;
  virtual Value at(const Vec3d& p) const = 0;
};
using SolidPtr = std::shared_ptr<const Solid>;

/// Of unit length.
Vec3d random_direction(Random& random);

/// A solid of planes, spheres, cylinders, cones and tori, joined, cut and blended at random, within
/// about the unit ball.
SolidPtr random_solid(Random& random);

/// A point of the surface near `p`, found along the gradient.
Vec3d nearest_on(const Solid& solid, Vec3d p);

/// The surface of `solid` with vertices about `spacing` apart, on its sharp edges too, in an
/// irregular triangulation.
TriangleMesh surface_of(const Solid& solid, double spacing, Random& random);

}  // namespace burnish::training
