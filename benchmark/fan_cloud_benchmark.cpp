#include <benchmark/benchmark.h>

#include <cmath>

#include "burnish/base/random.h"
#include "burnish/triangulation/fan_cloud.h"

// What fans cost on a sphere of random points; the first argument is how many.
namespace burnish {
namespace {

Vec3f on_sphere(Random& random) {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return Vec3f(normalized(Vec3d{x, y, z}));
}

FanCloud sphere(std::int64_t count, FanVariant variant) {
  Random random(1);
  std::vector<Vec3f> points;
  for (std::int64_t i = 0; i < count; ++i) points.push_back(on_sphere(random));
  Context context;
  return FanCloud::build(points, {}, {.variant = variant}, context).value();
}

/// One point goes and one comes, each at a random place: an iteration is two edits.
void edit_fan_cloud(benchmark::State& state, FanVariant variant) {
  FanCloud cloud = sphere(state.range(0), variant);
  Random random(2);
  if (!cloud.add(on_sphere(random))) return state.SkipWithError("a point was refused");
  for (auto _ : state) {
    if (!cloud.remove(static_cast<std::uint32_t>(random.below(cloud.size()))) ||
        !cloud.add(on_sphere(random))) {
      return state.SkipWithError("an edit was refused");
    }
  }
  state.SetItemsProcessed(2 * state.iterations());
}
BENCHMARK_CAPTURE(edit_fan_cloud, ring, FanVariant::ring)
    ->RangeMultiplier(10)
    ->Range(10000, 1000000)
    ->Iterations(20000)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(edit_fan_cloud, delaunay, FanVariant::delaunay)
    ->RangeMultiplier(10)
    ->Range(10000, 1000000)
    ->Iterations(20000)
    ->Unit(benchmark::kMicrosecond);

void build_fan_cloud(benchmark::State& state, FanVariant variant) {
  for (auto _ : state) benchmark::DoNotOptimize(sphere(state.range(0), variant));
  state.SetItemsProcessed(state.range(0) * state.iterations());
}
BENCHMARK_CAPTURE(build_fan_cloud, ring, FanVariant::ring)
    ->RangeMultiplier(10)
    ->Range(10000, 1000000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(build_fan_cloud, delaunay, FanVariant::delaunay)
    ->RangeMultiplier(10)
    ->Range(10000, 1000000)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace burnish
