#pragma once

#include "burnish/base/random.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish::test {

/// `mesh` with independent normal errors of standard deviation `sigma` added to every coordinate.
inline TriangleMesh with_noise(TriangleMesh mesh, double sigma, std::uint64_t seed) {
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    Random random(seed, v);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      mesh.positions[v][axis] += static_cast<float>(sigma * random.normal());
    }
  }
  return mesh;
}

/// Triangles between random vertices: non-manifold edges, several fans, unused vertices, duplicates
/// and triangles that name a vertex twice.
inline TriangleMesh random_mesh(std::size_t vertices, std::size_t triangles, std::uint64_t seed) {
  Random random(seed);
  TriangleMesh mesh;
  mesh.positions.resize(vertices);
  for (Vec3f& p : mesh.positions) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      p[axis] = static_cast<float>(random.uniform(-1, 1));
  }
  mesh.triangles.resize(triangles);
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& v : t) v = static_cast<std::uint32_t>(random.below(vertices));
  }
  return mesh;
}

}  // namespace burnish::test
