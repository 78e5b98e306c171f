#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "burnish/pipeline/live_mesh.h"
#include "burnish/sensor/frame_sequence.h"
#include "burnish/sensor/virtual_camera.h"
#include "burnish/shapes/shapes.h"

// How long a depth frame of 640 x 480 takes on its way to a smoothed mesh, on one thread:
//   burnish_benchmark_frames [FRAMES [ROUNDS]]
// for virtual frames, and those of the folder FRAMES, each ROUNDS times (20).
namespace {

using namespace burnish;
/// Two clocks: what passes, and what this program has of it where others use the machine, too.
class Stopwatch {
 public:
  double wall() const {
    return std::chrono::duration<double, std::milli>(Clock::now() - wall_).count();
  }
  double processor() const {
    return 1e3 * static_cast<double>(std::clock() - processor_) / CLOCKS_PER_SEC;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point wall_ = Clock::now();
  std::clock_t processor_ = std::clock();
};

/// Times of one thing, over all frames.
struct Times {
  const char* name;
  std::vector<double> wall{}, processor{};

  void print() {
    std::printf("  %-34s", name);
    for (auto* values : {&wall, &processor}) {
      std::sort(values->begin(), values->end());
      const auto at = [&](double share) {
        return (*values)[static_cast<std::size_t>(share * static_cast<double>(values->size() - 1))];
      };
      std::printf("  %6.1f %6.1f %6.1f %6.1f", values->front(), at(0.5), at(0.99), values->back());
    }
    std::printf("\n");
  }
};

/// Works on all frames again and again, round by round.
bool measure(const char* title, const std::vector<DepthFrame>& frames, int rounds) {
  Context context;
  context.threads = 1;
  Times mesh{"unproject, mesh, 3 passes of Eq. 1"}, with_normals{"with normals"};
  Times unprojection{"unproject alone"}, organized{"organized mesh alone"};
  LiveMesh live, shaded({.normals = true});
  PointCloud cloud;
  OrganizedTriangulator triangulator;
  TriangleMesh raw;
  std::size_t triangles = 0;
  for (int round = 0; round <= rounds; ++round) {
    for (const DepthFrame& frame : frames) {
      Stopwatch watch;
      const auto time = [&](Times& times, const Result<void>& done) {
        if (!done) std::fprintf(stderr, "%s\n", done.error().text().c_str());
        if (round > 0) {  // the first round finds memory that nobody has touched
          times.wall.push_back(watch.wall());
          times.processor.push_back(watch.processor());
        }
        watch = {};
        return done.has_value();
      };
      if (!time(mesh, live.update(frame, context)) ||
          !time(with_normals, shaded.update(frame, context)) ||
          !time(unprojection, unproject_into(frame, {}, context, cloud)) ||
          !time(organized, triangulator.triangulate(cloud, {}, context, raw))) {
        return false;
      }
      triangles += round > 0 ? live.mesh().triangles.size() : 0;
    }
  }
  std::printf("%s: %zu frames, %zu triangles each\n", title, mesh.wall.size(),
              triangles / mesh.wall.size());
  std::printf("  %-34s  %6s %6s %6s %6s  %6s %6s %6s %6s\n", "ms; then of processor time", "least",
              "median", "99 %", "most", "least", "median", "99 %", "most");
  for (Times* times : {&mesh, &with_normals, &unprojection, &organized}) times->print();
  return true;
}

Result<std::vector<DepthFrame>> virtual_frames() {
  const Sensor sensor = find_sensor("kinect_v1").value();
  const auto camera = VirtualCamera::create(make_box({4, 3, 3}, 20), sensor);
  if (!camera) return camera.error();
  std::vector<DepthFrame> frames;
  for (std::uint64_t view = 0; view < 10; ++view) {
    const double turn = 0.3 * static_cast<double>(view);
    auto frame = camera->capture(
        look_at({-1.5, 0.2, 0.3}, {0.5 * turn - 0.5, 1 - turn, 0.1 * turn}, {0, 0, 1}),
        {.view = view});
    if (!frame) return std::move(frame).error();
    frames.push_back(*std::move(frame));
  }
  return frames;
}

Result<std::vector<DepthFrame>> frames_of(const char* folder) {
  const auto sequence = open_frames({folder});
  if (!sequence) return sequence.error();
  std::vector<DepthFrame> frames;
  for (std::size_t i = 0; i < sequence->size(); ++i) {
    auto frame = sequence->read(i);
    if (!frame) return std::move(frame).error();
    frames.push_back(*std::move(frame));
  }
  return frames;
}

bool measure(const char* title, const Result<std::vector<DepthFrame>>& frames, int rounds) {
  if (frames) return measure(title, *frames, rounds);
  std::fprintf(stderr, "%s\n", frames.error().text().c_str());
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 20;
  if (rounds < 1) return 2;
  bool done = measure("virtual Kinect in a room", virtual_frames(), 3 * rounds);
  if (argc > 1) done = measure(argv[1], frames_of(argv[1]), rounds) && done;
  return done ? 0 : 1;
}
