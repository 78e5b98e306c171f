#include "burnish/sensor/recording_folder.h"

#include <fmt/format.h>

#include <algorithm>

#include "burnish/io/depth_image.h"
#include "burnish/io/file.h"
#include "burnish/sensor/color_image.h"
#include "burnish/sensor/nearest_time.h"

namespace burnish {
namespace fs = std::filesystem;

Result<ColorImage> read_color(const ColorFile& file) {
  if (file.image.empty()) return ColorImage{};
  auto color = read_color_image(file.image);
  if (color) color->time = file.time;
  return color;
}

Result<RecordedFrame> FolderRecording::read(std::size_t i) {
  const FrameFile& file = files_[i];
  const auto bytes = read_file(file.image);
  if (!bytes) return bytes.error();
  const auto image = decode_depth_image(bytes->bytes());
  if (!image) {
    return Error{image.error().code, image.error().message, file.image.string()};
  }
  if (!image->integer) {
    return Error{ErrorCode::unsupported, "the depths are floats, 16-bit whole numbers are expected",
                 file.image.string()};
  }
  RecordedFrame frame{image->width, image->height, {}};
  frame.depth.assign(image->values.begin(), image->values.end());
  if (bytes->text().starts_with("\x89PNG")) frame.png = bytes->text();
  if (timed_) frame.time = file.time;
  frame.T_world_camera = file.T_world_camera;
  auto color = read_color(colors_[i]);
  if (!color) return color.error();
  frame.color = *std::move(color);
  return frame;
}

Result<PosedFolder> open_posed_folder(const fs::path& path, const ImportParams& params) {
  PosedFolder folder;
  auto layout = find_frames({path});
  if (!layout) return layout.error();
  folder.layout = *std::move(layout);
  folder.files = files_of(folder.layout);
  if (params.poses) {
    const auto posed =
        find_poses(folder.layout, {}, params.time_window, folder.files, folder.info.notes);
    if (!posed) return posed.error();
  }
  const auto beside = find_beside(folder.layout, {"camera.txt", "camera-intrinsics.txt"});
  if (!beside) return folder;
  const auto camera = read_camera_file(*beside);
  if (!camera) return camera.error();
  folder.info.camera = *camera;
  return folder;
}

std::vector<ColorFile> nearest_colors(const ImageList& colors, const std::vector<FrameFile>& files,
                                      double window, std::vector<std::string>& notes) {
  const NearestTime times(colors.times);
  std::vector<ColorFile> nearest(files.size());
  std::size_t without = 0;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (const auto found = times.find(files[i].time, window)) {
      nearest[i] = {colors.images[*found], colors.times[*found]};
    } else {
      ++without;
    }
  }
  if (without > 0) {
    notes.push_back(fmt::format("{} of {} depth images have no colour image within {} s", without,
                                files.size(), window));
  }
  return nearest;
}

}  // namespace burnish
