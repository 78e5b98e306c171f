#include <benchmark/benchmark.h>

#include <cmath>

#include "burnish/base/random.h"
#include "burnish/triangulation/fan_cloud.h"

// What fans cost on a sphere of random points; the first argument is how many. An edit should cost
// the same in a cloud of any size.
namespace burnish {
namespace {

Vec3f on_sphere(Random& random) {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return Vec3f(normalized(Vec3d{x, y, z}));
}

std::vector<Vec3f> sphere(std::int64_t count) {
  Random random(1);
  std::vector<Vec3f> points;
  for (std::int64_t i = 0; i < count; ++i) points.push_back(on_sphere(random));
  return points;
}

/// One point goes and one comes, each at a random place: an iteration is two edits.
void edit_fan_cloud(benchmark::State& state, FanVariant variant) {
  FanCloud cloud = FanCloud::build(sphere(state.range(0)), {}, {.variant = variant}).value();
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
  const std::vector<Vec3f> points = sphere(state.range(0));
  for (auto _ : state) {
    benchmark::DoNotOptimize(FanCloud::build(points, {}, {.variant = variant}).value());
  }
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
