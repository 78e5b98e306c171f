#include <cstdio>
#include <numbers>
#include <string>

#include "burnish/base/random.h"
#include "burnish/catalogue/operations.h"
#include "burnish/core/edges.h"
#include "burnish/io/geometry_file.h"
#include "burnish/measure/triangle_quality.h"
#include "burnish/shapes/shapes.h"

// burnish_benchmark_evenness MESH...: what 1 to 20 passes of Eq. 1 and of its neighbours make of
// the distances to the neighbours, of angles and of the size, on two spheres and on the meshes
// named, as tables in Markdown. A cell holds the spread of the distances to the neighbours, the
// mean of the triangles' least angles, and how far the vertices have moved inwards, in mean edges.
namespace burnish {
namespace {

constexpr int kPasses[] = {1, 2, 5, 10, 20};
constexpr const char* kMethods[] = {"nearest_farthest", "one_ring_mean", "taubin", "humphrey",
                                    "equalize"};

int fail(const Error& error) {
  std::fprintf(stderr, "%s\n", error.text().c_str());
  return 1;
}

/// Normal errors of a fifth of the mean edge in every coordinate.
TriangleMesh noisy(TriangleMesh mesh) {
  const double sigma = 0.2 * mean_edge_length(mesh);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    Random random(7, v);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      mesh.positions[v][axis] += static_cast<float>(sigma * random.normal());
    }
  }
  return mesh;
}

double moved_inwards(const TriangleMesh& before, const TriangleMesh& after) {
  const std::vector<Vec3f> normals = vertex_normals(before);
  double sum = 0;
  for (std::size_t v = 0; v < normals.size(); ++v) {
    sum += dot(Vec3d(normals[v]), Vec3d(before.positions[v]) - Vec3d(after.positions[v]));
  }
  return sum / static_cast<double>(normals.size()) / mean_edge_length(before);
}

Result<void> print_cell(const TriangleMesh& before, const TriangleMesh& after) {
  const auto quality = triangle_quality(after);
  if (!quality) return quality.error();
  const double inwards = moved_inwards(before, after);
  std::printf(" .%03.0f, %.1f°, %.3f |", 1000 * quality->neighbour_distance_spread,
              quality->smallest_angle_mean * 180 / std::numbers::pi,
              std::abs(inwards) < 5e-4 ? 0 : inwards);
  return {};
}

Result<void> print_table(const std::string& name, const TriangleMesh& mesh) {
  std::printf("\n| %s |", name.c_str());
  for (const int passes : kPasses) std::printf(" %d |", passes);
  std::printf("\n|---|---|---|---|---|---|\n| before |");
  if (auto printed = print_cell(mesh, mesh); !printed) return printed;
  std::printf(" | | | |\n");
  for (const std::string method : kMethods) {
    std::printf("| `%s` |", method.c_str());
    for (const int passes : kPasses) {
      TriangleMesh smoothed = mesh;
      const auto operation = find_smooth(method);
      if (!operation) return operation.error();
      const auto done = (*operation)->run(smoothed, {{"iterations", std::to_string(passes)}}, {});
      if (!done) return done.error();
      if (auto printed = print_cell(mesh, smoothed); !printed) return printed;
    }
    std::printf("\n");
  }
  return {};
}

}  // namespace
}  // namespace burnish

int main(int argc, char** argv) {
  using namespace burnish;
  const TriangleMesh sphere = make_sphere(1, 5);
  if (auto done = print_table("nearly regular sphere", sphere); !done) return fail(done.error());
  if (auto done = print_table("noisy sphere", noisy(sphere)); !done) return fail(done.error());
  for (int i = 1; i < argc; ++i) {
    const Result<TriangleMesh> mesh = read_mesh(argv[i]);
    if (!mesh) return fail(mesh.error());
    if (auto done = print_table(argv[i], *mesh); !done) return fail(done.error());
  }
}
