#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "burnish/base/context.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// Finds where rays first meet a mesh, from either side. Holds its own copy of the triangles, in
/// the coordinates of `mesh.positions` (frame.origin is not added). Casting is safe from many
/// threads at once, and what is hit does not depend on how many threads built the tree. Watertight:
/// a ray through an edge or vertex of a closed surface does not slip through.
///
/// Building takes O(#T log #T), a cast O(log #T) on ordinary meshes. Embree (Wald et al. 2014)
/// finds the triangle in single precision; distance and coordinates are then recomputed in double.
class RayCaster {
 public:
  /// `mesh` must pass check(mesh); one without triangles is never hit, and no more is one whose
  /// building was cancelled. Throws std::bad_alloc.
  explicit RayCaster(const TriangleMesh& mesh, const Context& context = {});
  ~RayCaster();
  RayCaster(RayCaster&&) noexcept;
  RayCaster& operator=(RayCaster&&) noexcept;

  struct Hit {
    std::uint32_t triangle;
    double distance;  ///< along the ray, in units of the mesh, not negative
    double u, v;      ///< the point is (1 - u - v) a + u b + v c of the triangle's corners
  };

  /// The first hit of the ray from `origin` along `unit_direction`; of triangles that share the
  /// point the one with the smallest (distance, index).
  std::optional<Hit> cast(const Vec3d& origin, const Vec3d& unit_direction) const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace burnish
