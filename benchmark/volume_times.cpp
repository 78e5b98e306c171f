#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "burnish/io/geometry_file.h"
#include "burnish/sensor/frame_sequence.h"
#include "burnish/triangulation/distance_volume.h"
#include "burnish/triangulation/iso_surface.h"

// burnish_benchmark_volume FOLDER VOXEL THREADS [ROUNDS] [OUT.ply]
// Milliseconds a frame for the integration of all frames of a folder, as the peer
// (peers/open3d_volume.cpp) measures it: least and median of the rounds' means; then for the
// surface. Of the processor, reading left out.
namespace {

using namespace burnish;

[[noreturn]] void fail(const Error& error) {
  std::fprintf(stderr, "%s\n", error.text().c_str());
  std::exit(1);
}

/// Of the processor, on all threads: others may use the machine at the same time.
double milliseconds_since(std::clock_t start) {
  return 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) return 2;
  const Result<FrameSequence> sequence = open_frames({argv[1]}, {.sensor = "kinect_v1"});
  if (!sequence) fail(sequence.error());
  std::vector<DepthFrame> frames;
  for (std::size_t i = 0; i < sequence->size(); ++i) {
    Result<DepthFrame> frame = sequence->read(i);
    if (!frame) fail(frame.error());
    frames.push_back(*std::move(frame));
  }
  const double voxel = std::atof(argv[2]);
  Context context;
  context.threads = std::atoi(argv[3]);
  const int rounds = argc > 4 ? std::atoi(argv[4]) : 5;
  std::vector<double> integration, surface;
  for (int round = 0; round < rounds; ++round) {
    DistanceVolume volume(voxel);
    const auto start = std::clock();
    for (const DepthFrame& frame : frames) {
      if (auto added = volume.integrate(frame, context); !added) fail(added.error());
    }
    integration.push_back(milliseconds_since(start) / static_cast<double>(frames.size()));
    const auto middle = std::clock();
    const Result<TriangleMesh> mesh = iso_surface(volume, 1, context);
    if (!mesh) fail(mesh.error());
    surface.push_back(milliseconds_since(middle));
    if (round > 0) continue;
    std::printf("%zu frames, %zu blocks, %zu vertices, %zu triangles\n", frames.size(),
                volume.blocks().size(), mesh->positions.size(), mesh->triangles.size());
    if (argc > 5) {
      if (auto written = write_mesh(argv[5], *mesh); !written) fail(written.error());
    }
  }
  std::sort(integration.begin(), integration.end());
  std::sort(surface.begin(), surface.end());
  const std::size_t middle = integration.size() / 2;
  std::printf(
      "processor ms a frame: least %.2f median %.2f; ms for the surface: least %.1f median %.1f\n",
      integration[0], integration[middle], surface[0], surface[middle]);
}
