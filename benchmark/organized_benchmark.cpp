#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>

#include "burnish/points/unproject.h"
#include "burnish/sensor/frame_sequence.h"
#include "burnish/sensor/virtual_camera.h"
#include "burnish/shapes/shapes.h"
#include "burnish/triangulation/organized.h"

// The mesh of one depth image of 640 x 480, all attributes carried: of a box of a room's size seen
// from inside by a virtual Kinect, and of real frames where BURNISH_TEST_DATA names a folder of
// them. The argument is the number of threads.
namespace burnish {
namespace {

void triangulate(benchmark::State& state, const Result<DepthFrame>& frame) {
  if (!frame) return state.SkipWithError(frame.error().text().c_str());
  const Result<PointCloud> cloud = unproject(*frame);
  if (!cloud) return state.SkipWithError(cloud.error().text().c_str());
  Context context;
  context.threads = static_cast<int>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(triangulate_organized(*cloud, {}, context));
  state.SetItemsProcessed(static_cast<std::int64_t>(cloud->positions.size()) * state.iterations());
}

void organized_virtual_frame(benchmark::State& state) {
  const Result<Sensor> sensor = find_sensor("kinect_v1");
  const Result<VirtualCamera> camera = VirtualCamera::create(make_box({4, 3, 3}, 20), *sensor);
  triangulate(state, camera->capture(look_at({-1.5, 0.2, 0.3}, {1, 0, 0}, {0, 0, 1})));
}
BENCHMARK(organized_virtual_frame)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);

void organized_real_frame(benchmark::State& state) {
  const char* folder = std::getenv("BURNISH_TEST_DATA");
  if (!folder) return state.SkipWithError("BURNISH_TEST_DATA is not set");
  const auto frames = open_frames({std::filesystem::path(folder) / "depth/kinect_v1_kitchen"}, {});
  if (!frames) return state.SkipWithError(frames.error().text().c_str());
  triangulate(state, frames->read(static_cast<std::size_t>(state.range(1))));
}
BENCHMARK(organized_real_frame)->ArgsProduct({{1, 2}, {0, 7, 14}})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace burnish
