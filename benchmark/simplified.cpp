#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "burnish/core/topology.h"
#include "burnish/io/geometry_file.h"
#include "peers/plain_mesh.h"
#include "two_sided_distance.h"

// burnish_benchmark_simplified ORIGINAL SAMPLES RESULT.ply...: a line of JSON for each result of
// simplifying ORIGINAL (as peers/plain_mesh.h reads it): its distances from the original, as shares
// of the diagonal of the original's box, and how it hangs together. The first line is the original.
namespace burnish {
namespace {

double diagonal(const TriangleMesh& mesh) {
  Vec3f low = mesh.positions.front(), high = low;
  for (const Vec3f& p : mesh.positions) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  return norm(Vec3d(high) - Vec3d(low));
}

void print(const TriangleMesh& mesh, const TwoSidedDistance& distance, double unit) {
  const Topology is = topology(mesh);
  std::printf(
      "{\"triangles\": %zu, \"rms\": %.9g, \"rms_there\": %.9g, \"rms_back\": %.9g, \"hausdorff\": "
      "%.9g, \"non_manifold_edges\": %zu, \"non_manifold_vertices\": %zu, \"flipped_edges\": %zu, "
      "\"boundary_edges\": %zu, \"duplicate_triangles\": %zu, \"euler_number\": %lld}\n",
      mesh.triangles.size(), distance.rms() / unit, distance.rms_there / unit,
      distance.rms_back / unit, distance.hausdorff() / unit, is.non_manifold_edges,
      is.non_manifold_vertices, is.flipped_edges, is.boundary_edges, is.duplicate_triangles,
      static_cast<long long>(is.euler_number));
}

}  // namespace
}  // namespace burnish

int main(int argc, char** argv) {
  using namespace burnish;
  if (argc < 3) return 2;
  PlainMesh plain = read_plain_mesh(argv[1]);
  TriangleMesh mesh;
  for (const auto& [x, y, z] : plain.positions) mesh.positions.push_back({x, y, z});
  mesh.triangles = std::move(plain.triangles);
  const MeasuredSurface original(std::move(mesh));
  const double unit = diagonal(original.mesh);
  print(original.mesh, {}, unit);
  for (int i = 3; i < argc; ++i) {
    Result<TriangleMesh> result = read_mesh(argv[i]);
    if (!result) {
      std::fprintf(stderr, "%s: %s\n", argv[i], result.error().message.c_str());
      return 1;
    }
    const MeasuredSurface simplified(*std::move(result));
    print(simplified.mesh, two_sided_distance(original, simplified, std::stoul(argv[2])), unit);
  }
}
