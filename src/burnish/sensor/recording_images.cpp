#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "burnish/sensor/recording_folder.h"

namespace burnish {
namespace fs = std::filesystem;
namespace {

constexpr double kMillimetre = 0.001;

bool recognise_images(const RecordingPlace& place) {
  return place.is_folder && find_frames({place.path}).has_value();
}

/// The NAME.color.png or .jpg beside every NAME.depth.png (7-Scenes), where there is one.
std::vector<ColorFile> colors_beside(const std::vector<FrameFile>& files) {
  std::vector<ColorFile> colors;
  for (const FrameFile& file : files) {
    const fs::path name = file.image.stem();
    ColorFile color;
    for (const char* ending : {".color.png", ".color.jpg"}) {
      std::error_code ignored;
      const fs::path image = file.image.parent_path() / (name.stem().string() + ending);
      if (name.extension() != ".depth" || !fs::is_regular_file(image, ignored)) continue;
      color.image = image;
      break;
    }
    colors.push_back(color);
  }
  return colors;
}

/// The times (s) that names say as `number-microseconds` (Redwood's object scans); empty unless all
/// do.
std::vector<double> times_from_names(const std::vector<fs::path>& images) {
  std::vector<double> times;
  for (const fs::path& image : images) {
    const std::string stem = image.stem().string();
    const std::size_t dash = stem.find('-');
    if (dash == stem.npos) return {};
    std::uint64_t microseconds = 0;
    const char* end = stem.data() + stem.size();
    const auto [rest, status] = std::from_chars(stem.data() + dash + 1, end, microseconds);
    if (status != std::errc{} || rest != end) return {};
    times.push_back(double(microseconds) / 1e6);
  }
  return times;
}

bool is_picture(const fs::path& path) {
  const std::string ending = path.extension().string();
  return ending == ".png" || ending == ".jpg" || ending == ".jpeg" || ending == ".ppm";
}

/// The pictures of the first folder beside `depth` that holds any, in natural order.
std::vector<fs::path> pictures_beside(const fs::path& parent) {
  std::vector<fs::path> pictures;
  for (const char* name : {"color", "rgb", "image"}) {
    std::error_code failed;
    for (fs::directory_iterator entry(parent / name, failed), end; !failed && entry != end;
         entry.increment(failed)) {
      if (is_picture(entry->path())) pictures.push_back(entry->path());
    }
    if (!pictures.empty()) break;
  }
  std::sort(pictures.begin(), pictures.end(), [](const fs::path& a, const fs::path& b) {
    return natural_less(a.filename().string(), b.filename().string());
  });
  return pictures;
}

/// Colours for a folder `depth` from the folder beside it: by the times in their names where
/// `timed` says that the depth images have times, or one by one.
std::vector<ColorFile> colors_above(PosedFolder& folder, bool timed, double window) {
  std::vector<ColorFile> colors(folder.files.size());
  const std::vector<fs::path> pictures = pictures_beside(folder.layout.folders.back());
  if (pictures.empty()) return colors;
  const ImageList list{pictures, times_from_names(pictures)};
  if (timed && !list.times.empty()) {
    return nearest_colors(list, folder.files, window, folder.info.notes);
  }
  if (pictures.size() == colors.size()) {
    for (std::size_t i = 0; i < colors.size(); ++i) colors[i].image = pictures[i];
  } else {
    folder.info.notes.push_back(
        fmt::format("the {} colour images are left out: there are {} depth images, and the names "
                    "tell no times",
                    pictures.size(), colors.size()));
  }
  return colors;
}

/// Depth images in millimetres: 7-Scenes (Shotton et al. 2013) with a pose beside each, or Redwood
/// (Choi et al. 2015) in a folder `depth` with a trajectory.log above.
Result<std::unique_ptr<Recording>> open_images(const fs::path& path, const ImportParams& params) {
  auto folder = open_posed_folder(path, params);
  if (!folder) return folder.error();
  if (!folder->info.camera.depth_scale) folder->info.camera.depth_scale = kMillimetre;
  bool timed = !folder->layout.times.empty();
  if (const auto times = times_from_names(folder->layout.images); !timed && !times.empty()) {
    timed = true;
    for (std::size_t i = 0; i < times.size(); ++i) folder->files[i].time = times[i];
  }
  std::vector<ColorFile> colors = folder->layout.folders.size() > 1
                                      ? colors_above(*folder, timed, params.time_window)
                                      : colors_beside(folder->files);
  return std::unique_ptr<Recording>(std::make_unique<FolderRecording>(
      std::move(folder->info), std::move(folder->files), timed, std::move(colors)));
}

}  // namespace

RecordingFormat images_format() {
  return {"images", "folder of depth images (7-Scenes; Redwood: depth/*.png, trajectory.log)",
          recognise_images, open_images};
}

}  // namespace burnish
