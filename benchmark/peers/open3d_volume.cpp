#include <open3d/geometry/RGBDImage.h>
#include <open3d/geometry/TriangleMesh.h>
#include <open3d/io/ImageIO.h>
#include <open3d/io/TriangleMeshIO.h>
#include <open3d/pipelines/integration/ScalableTSDFVolume.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

// volume_open3d FOLDER VOXEL [ROUNDS] [OUT.ply]: ScalableTSDFVolume as Open3D's tutorial on RGB-D
// integration uses it (truncation 8 voxels: 0.04 m at 5 mm), without colour, up to 4.5 m. FOLDER is
// in the layout of 7-Scenes. Prints what burnish_benchmark_volume prints. Threads: OMP_NUM_THREADS.
namespace fs = std::filesystem;
using open3d::pipelines::integration::ScalableTSDFVolume;

struct Frame {
  open3d::geometry::RGBDImage image;
  Eigen::Matrix4d T_camera_world;
};

static std::vector<Frame> read_frames(const fs::path& folder) {
  std::vector<fs::path> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.size() > 10 && name.compare(name.size() - 10, 10, ".depth.png") == 0) {
      names.push_back(entry.path());
    }
  }
  std::sort(names.begin(), names.end());
  std::vector<Frame> frames;
  for (const fs::path& path : names) {
    open3d::geometry::Image depth;
    if (!open3d::io::ReadImage(path.string(), depth)) std::exit(1);
    for (int v = 0; v < depth.height_; ++v) {
      for (int u = 0; u < depth.width_; ++u) {
        auto* z = depth.PointerAt<std::uint16_t>(u, v);
        if (*z == 65535) *z = 0;
      }
    }
    std::string pose_name = path.string();
    pose_name.replace(pose_name.size() - 9, 9, "pose.txt");
    std::ifstream pose(pose_name);
    Eigen::Matrix4d T;
    for (int i = 0; i < 16; ++i) pose >> T(i / 4, i % 4);
    Frame frame;
    frame.image.depth_ = *depth.ConvertDepthToFloatImage(1000, 4.5);
    frame.image.color_.Prepare(depth.width_, depth.height_, 1, 4);
    frame.T_camera_world = T.inverse();
    frames.push_back(std::move(frame));
  }
  return frames;
}

/// Of the processor, on all threads: others may use the machine at the same time.
static double milliseconds_since(std::clock_t start) {
  return 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const std::vector<Frame> frames = read_frames(argv[1]);
  // Four numbers, or a 3 x 3 matrix row by row.
  std::ifstream file(fs::path(argv[1]) / "camera-intrinsics.txt");
  std::vector<double> k;
  for (double number; file >> number;) k.push_back(number);
  if (k.size() == 9) k = {k[0], k[4], k[2], k[5]};
  if (k.size() < 4 || frames.empty()) return 1;
  const open3d::camera::PinholeCameraIntrinsic camera(
      frames[0].image.depth_.width_, frames[0].image.depth_.height_, k[0], k[1], k[2], k[3]);
  const double voxel = std::atof(argv[2]);
  const int rounds = argc > 3 ? std::atoi(argv[3]) : 3;
  std::vector<double> integration, surface;
  for (int round = 0; round < rounds; ++round) {
    ScalableTSDFVolume volume(voxel, 8 * voxel,
                              open3d::pipelines::integration::TSDFVolumeColorType::NoColor);
    const auto start = std::clock();
    for (const Frame& frame : frames) volume.Integrate(frame.image, camera, frame.T_camera_world);
    integration.push_back(milliseconds_since(start) / static_cast<double>(frames.size()));
    const auto middle = std::clock();
    const auto mesh = volume.ExtractTriangleMesh();
    surface.push_back(milliseconds_since(middle));
    if (round > 0) continue;
    std::printf("%zu frames, %zu vertices, %zu triangles\n", frames.size(), mesh->vertices_.size(),
                mesh->triangles_.size());
    if (argc > 4) open3d::io::WriteTriangleMesh(argv[4], *mesh);
  }
  std::sort(integration.begin(), integration.end());
  std::sort(surface.begin(), surface.end());
  const std::size_t middle = integration.size() / 2;
  std::printf(
      "processor ms a frame: least %.2f median %.2f; ms for the surface: least %.1f median %.1f\n",
      integration[0], integration[middle], surface[0], surface[middle]);
}
