#include <benchmark/benchmark.h>

#include "burnish/catalogue/operations.h"
#include "burnish/core/adjacency.h"
#include "burnish/shapes/shapes.h"

// What the stages cost on a sphere of 4^n * 20 triangles. The first argument is n.
namespace burnish {
namespace {

void count_triangles(benchmark::State& state, const TriangleMesh& mesh) {
  state.SetItemsProcessed(static_cast<std::int64_t>(mesh.triangles.size()) * state.iterations());
}

void one_rings_of_a_sphere(benchmark::State& state) {
  const TriangleMesh mesh = make_sphere(1, static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(one_rings(mesh));
  count_triangles(state, mesh);
}
BENCHMARK(one_rings_of_a_sphere)->DenseRange(5, 7)->Unit(benchmark::kMillisecond);

void smooth(benchmark::State& state, const SmoothOperation& operation) {
  const TriangleMesh sphere = make_sphere(1, static_cast<int>(state.range(0)));
  for (auto _ : state) {
    TriangleMesh mesh = sphere;
    if (!operation.run(mesh, {}, {})) state.SkipWithError("the operation failed");
  }
  count_triangles(state, sphere);
}

void triangulate(benchmark::State& state, const TriangulateOperation& operation) {
  const TriangleMesh sphere = make_sphere(1, static_cast<int>(state.range(0)));
  PointCloud cloud;
  cloud.positions = sphere.positions;
  cloud.attributes.normals = vertex_normals(sphere);
  for (auto _ : state) {
    if (!operation.run(cloud, {}, {})) return state.SkipWithError("works on organized clouds only");
  }
  count_triangles(state, sphere);
}

// A row for every method of the catalogue.
const int registered = [] {
  for (const SmoothOperation& operation : smooth_operations()) {
    benchmark::RegisterBenchmark(("smooth/" + operation.info.name).c_str(), smooth, operation)
        ->DenseRange(5, 7)
        ->Unit(benchmark::kMillisecond);
  }
  for (const TriangulateOperation& operation : triangulate_operations()) {
    benchmark::RegisterBenchmark(("triangulate/" + operation.info.name).c_str(), triangulate,
                                 operation)
        ->DenseRange(5, 6)
        ->Unit(benchmark::kMillisecond);
  }
  return 0;
}();

}  // namespace
}  // namespace burnish
