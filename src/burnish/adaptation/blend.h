#pragma once

#include <cstdint>
#include <vector>

#include "burnish/core/edge_table.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// A weighted sum of vertices: of their positions, and of sigma where the mesh has it. With weights
/// that add to 1 the latter bounds the error of the former, however correlated the vertices' are.
struct Blend {
  Vec3d position;
  double sigma = 0;

  void add(const TriangleMesh& mesh, std::uint32_t v, double weight) {
    position += weight * Vec3d(mesh.positions[v]);
    if (!mesh.attributes.sigma.empty()) sigma += weight * mesh.attributes.sigma[v];
  }
  void add(const Blend& other, double weight) {
    position += weight * other.position;
    sigma += weight * other.sigma;
  }
};

/// The neighbours of a vertex that say where it goes.
struct Ring {
  Blend sum;                ///< of all of them, each with weight 1
  std::uint32_t count = 0;  ///< of them
  bool crease = false;      ///< those along creases alone
};

/// Per vertex its neighbours along creases, where it lies on one, otherwise all. `crease[e]` says
/// whether edge e is one: a boundary, or where the surface does not go on as one. O(#V + #E).
std::vector<Ring> rings_of(const TriangleMesh& mesh, const EdgeTable& edges,
                           const std::vector<bool>& crease);

/// Where the vertices of a refined mesh lie, the old ones first. At first the old ones lie where
/// they do, and of the new ones nothing is known.
class Placement {
 public:
  Placement(const TriangleMesh& mesh, std::size_t new_vertices);

  const Vec3f& operator[](std::size_t v) const { return positions_[v]; }
  void put(std::size_t v, const Blend& blend) {
    positions_[v] = Vec3f(blend.position);
    if (!sigma_.empty()) sigma_[v] = static_cast<float>(blend.sigma);
  }

  /// Gives `mesh`, whose attributes are already of all vertices, the positions. sigma becomes that
  /// of the blends where it is larger.
  void apply(TriangleMesh& mesh) &&;

 private:
  std::vector<Vec3f> positions_;
  std::vector<float> sigma_;  ///< empty where the mesh has none
};

}  // namespace burnish
