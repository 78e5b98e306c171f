#include "burnish/sensor/frame_folder.h"

#include <fmt/format.h>

#include <utility>

#include "burnish/io/png.h"
#include "burnish/sensor/pose_list.h"

namespace burnish {
namespace fs = std::filesystem;

Result<FrameFolder> FrameFolder::create(const fs::path& folder) {
  auto staging = StagingFolder::create(folder, "recording.json",
                                       {"depth.txt", "rgb.txt", "camera-intrinsics.txt"});
  if (!staging) return staging.error();
  return FrameFolder(*std::move(staging));
}

Result<void> FrameFolder::add(const RecordedFrame& frame) {
  const std::string name = fmt::format("frame-{:06}", frames_);
  const auto write = [&](const std::string& ending, std::string_view bytes) {
    return staging_.write(name + ending, bytes);
  };
  auto encoded = frame.png.empty() ? encode_png(frame.width, frame.height, frame.depth)
                                   : Result<std::string>(frame.png);
  if (!encoded) return encoded.error();
  if (auto written = write(".depth.png", *encoded); !written) return written;
  if (frame.time) depth_list_ += fmt::format("{:.6f} {}.depth.png\n", *frame.time, name);
  if (const ColorImage& color = frame.color; !color.bytes.empty()) {
    const std::string ending = ".color" + color.ending;
    if (auto written = write(ending, color.bytes); !written) return written;
    if (color.time) color_list_ += fmt::format("{:.6f} {}{}\n", *color.time, name, ending);
  }
  if (frame.T_world_camera) {
    const auto written = write(".pose.txt", pose_matrix_text(*frame.T_world_camera));
    if (!written) return written;
  }
  width_ = frame.width;
  height_ = frame.height;
  ++frames_;
  return {};
}

Result<void> FrameFolder::finish(CameraFile camera, const std::string& json) {
  std::vector<std::pair<const char*, std::string>> files{{"recording.json", json}};
  if (camera.camera) {
    if (camera.camera->width == 0) camera.camera->width = width_;
    if (camera.camera->height == 0) camera.camera->height = height_;
    files.emplace_back("camera-intrinsics.txt", intrinsics_text(*camera.camera));
  }
  files.emplace_back("camera.txt", camera_file_text(camera));
  if (!depth_list_.empty()) files.emplace_back("depth.txt", "# s, depth image\n" + depth_list_);
  if (!color_list_.empty()) files.emplace_back("rgb.txt", "# s, colour image\n" + color_list_);
  for (const auto& [name, text] : files) {
    if (auto written = staging_.write(name, text); !written) return written;
  }
  return staging_.commit();
}

}  // namespace burnish
