#include "examples.h"

#include <algorithm>
#include <cmath>

#include "burnish/core/edges.h"
#include "burnish/shapes/shapes.h"
#include "implicit_shape.h"

namespace burnish::training {
namespace {

TriangleMesh regular_shape(Random& random) {
  const int size = 20 + static_cast<int>(random.below(30));
  const double stretch = random.uniform(0.7, 3);  // of the triangles
  const int across = static_cast<int>(std::lround(stretch * size));
  switch (random.below(5)) {
    case 0: {
      const double x = random.uniform(0.5, 1.5), y = random.uniform(0.5, 1.5);
      return make_box({x, y, random.uniform(0.5, 1.5)}, size);
    }
    case 1:
      return make_sphere(1, 5);
    case 2:
      return make_torus(1, random.uniform(0.2, 0.6), 2 * size, across);
    case 3:
      return make_cylinder(random.uniform(0.4, 1), 2, 2 * across, size / 2);
    default:
      return make_uv_sphere(1, 2 * size, size);
  }
}

TriangleMesh clean_shape(Random& random) {
  if (random.below(5) == 0) return regular_shape(random);
  const SolidPtr solid = random_solid(random);
  return surface_of(*solid, 0.036 * std::pow(0.33, random.uniform()), random);
}

TriangleMesh with_white_noise(const TriangleMesh& clean, Random& random) {
  TriangleMesh noisy = clean;
  // Half of the meshes under strong noise, half under any.
  const double level =
      random.below(2) == 0 ? random.uniform(0.05, 0.8) : 0.8 * std::pow(0.04, random.uniform());
  const double sigma = level * mean_edge_length(clean);
  const std::vector<Vec3f> normals = vertex_normals(clean);
  const std::uint64_t kind = random.below(4);
  for (std::size_t v = 0; v < clean.positions.size(); ++v) {
    const double x = random.normal(), y = random.normal(), z = random.normal();
    const double chance = random.uniform();
    Vec3d move = kind == 0 ? 0.7 * Vec3d{x, y, z} : x * Vec3d(normals[v]);
    if (kind == 1) move = chance < 0.3 ? 1.5 * move : 0.1 * move;
    noisy.positions[v] = Vec3f(Vec3d(clean.positions[v]) + sigma * move);
  }
  return noisy;
}

}  // namespace

std::vector<Example> white_examples(int count, std::uint64_t seed) {
  std::vector<Example> examples;
  for (int i = 0; i < count; ++i) {
    Random random(seed, static_cast<std::uint64_t>(i));
    Example example;
    example.clean = clean_shape(random);
    example.noisy = with_white_noise(example.clean, random);
    examples.push_back(std::move(example));
  }
  return examples;
}

}  // namespace burnish::training
