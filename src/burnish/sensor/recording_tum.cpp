#include "burnish/sensor/recording_folder.h"

namespace burnish {
namespace fs = std::filesystem;
namespace {

bool recognise_tum(const RecordingPlace& place) {
  std::error_code ignored;
  return place.is_folder && fs::is_regular_file(place.path / "depth.txt", ignored);
}

/// TUM RGB-D (Sturm et al. 2012): depth.txt and rgb.txt list `timestamp file`, groundtruth.txt
/// holds `timestamp x y z qx qy qz qw`. Depth pixels are already those of the colour image.
Result<std::unique_ptr<Recording>> open_tum(const fs::path& path, const ImportParams& params) {
  auto folder = open_posed_folder(path, params);
  if (!folder) return folder.error();
  RecordingInfo& info = folder->info;
  info.registered = true;
  if (!info.camera.depth_scale) info.camera.depth_scale = kTumDepthScale;
  std::vector<ColorFile> colors(folder->files.size());
  std::error_code ignored;
  if (fs::is_regular_file(path / "rgb.txt", ignored)) {
    const auto list = read_image_list(path / "rgb.txt");
    if (!list) return list.error();
    colors = nearest_colors(*list, folder->files, params.time_window, info.notes);
  }
  return std::unique_ptr<Recording>(std::make_unique<FolderRecording>(
      std::move(info), std::move(folder->files), true, std::move(colors)));
}

}  // namespace

RecordingFormat tum_format() {
  return {"tum", "TUM RGB-D folder (depth.txt, rgb.txt, groundtruth.txt)", recognise_tum, open_tum};
}

}  // namespace burnish
