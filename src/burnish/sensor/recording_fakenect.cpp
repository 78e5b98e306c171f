#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "burnish/io/cursor.h"
#include "burnish/io/file.h"
#include "burnish/sensor/raw_disparity.h"
#include "burnish/sensor/recording_folder.h"

namespace burnish {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kDisparities = 2048;
/// 0.2 mm: a step of disparity is more than that at any distance, and 10 m fit into 16 bits.
constexpr double kUnit = 1.0 / 5000;

bool recognise_fakenect(const RecordingPlace& place) {
  std::error_code ignored;
  return place.is_folder && fs::is_regular_file(place.path / "INDEX.txt", ignored);
}

/// What INDEX.txt lists, by the first letter of the names.
struct Index {
  ImageList depth, color;
};

/// Reads lines `d-SECONDS-TICKS.pgm`, `r-SECONDS-TICKS.ppm` and `a-SECONDS-TICKS.dump`.
Result<Index> read_index(const fs::path& path) {
  const auto file = read_file(path);
  if (!file) return file.error();
  Index index;
  Cursor cursor(file->text(), path.string());
  for (; cursor.next_filled_line(); cursor.next_line()) {
    const std::string name(cursor.word());
    const std::size_t dash = std::min(name.find('-', 2), name.size());
    double time = 0;
    Cursor seconds(std::string_view(name).substr(std::min<std::size_t>(2, dash), dash - 2), {});
    const bool sound = name.size() > 2 && name[1] == '-' && dash < name.size() &&
                       seconds.number(time) && seconds.at_end() && std::isfinite(time) &&
                       std::string_view("dra").find(name[0]) != std::string_view::npos &&
                       name.find('/') == name.npos && cursor.at_line_end();
    if (!sound) {
      return cursor.line_error(
          fmt::format("'{}' is not d-SECONDS-TICKS.pgm, r-....ppm or a-....dump", shown(name)));
    }
    if (name[0] == 'a') continue;  // the accelerometer's
    ImageList& list = name[0] == 'd' ? index.depth : index.color;
    list.times.push_back(time);
    list.images.push_back(path.parent_path() / name);
  }
  if (index.depth.images.empty()) return cursor.line_error("the list names no depth image");
  return index;
}

/// The geometry that device.json tells of, of newer recordings.
Result<ZeroPlane> read_device(const fs::path& path) {
  const auto file = read_file(path);
  if (!file) return file.error();
  const auto damaged = [&](const char* message) {
    return Error{ErrorCode::bad_file, message, path.string()};
  };
  const auto json = nlohmann::json::parse(file->text(), nullptr, false);
  if (json.is_discarded()) return damaged("it is no JSON");
  ZeroPlane plane;
  const std::string zero = "/reg_info/zero_plane_info/";
  const std::array<std::pair<std::string, double*>, 4> numbers{
      {{zero + "dcmos_emitter_distance", &plane.emitter_distance},
       {zero + "reference_distance", &plane.reference_distance},
       {zero + "reference_pixel_size", &plane.reference_pixel_size},
       {"/const_shift", &plane.constant_shift}}};
  for (const auto& [key, value] : numbers) {
    const nlohmann::json::json_pointer place(key);
    if (!json.contains(place) || !json[place].is_number()) {
      return damaged("const_shift and reg_info.zero_plane_info are expected to hold numbers");
    }
    *value = json[place].get<double>();
    if (!(*value > 0 && std::isfinite(*value))) {
      return damaged("const_shift and reg_info.zero_plane_info must be positive");
    }
  }
  return plane;
}

/// What libfreenect's record dumps: raw disparities with the head of a PGM, but little endian.
class FakenectRecording : public Recording {
 public:
  static Result<std::unique_ptr<Recording>> open(const fs::path& folder,
                                                 const ImportParams& params) {
    auto index = read_index(folder / "INDEX.txt");
    if (!index) return index.error();
    auto recording = std::make_unique<FakenectRecording>();
    RecordingInfo& info = recording->info_;
    ZeroPlane plane;
    std::error_code ignored;
    if (fs::exists(folder / "device.json", ignored)) {
      const auto device = read_device(folder / "device.json");
      if (!device) return device.error();
      plane = *device;
    } else {
      info.notes.push_back(
          "there is no device.json: depths are computed with libfreenect's default geometry");
    }
    info.camera = {camera_of(plane), kUnit, "kinect_v1"};
    info.registered = false;
    info.said = {{"emitter_distance", fmt::format("{} cm", plane.emitter_distance)},
                 {"reference_distance", fmt::format("{} cm", plane.reference_distance)},
                 {"reference_pixel_size", fmt::format("{} cm", plane.reference_pixel_size)},
                 {"constant_shift", fmt::format("{}", plane.constant_shift)}};
    for (std::size_t raw = 0; raw < kDisparities; ++raw) {
      const double depth = depth_of_disparity(static_cast<std::uint16_t>(raw), plane);
      recording->depths_[raw] = static_cast<std::uint16_t>(std::round(depth / kUnit));
    }
    for (std::size_t i = 0; i < index->depth.images.size(); ++i)
      recording->files_.push_back({index->depth.images[i], {}, index->depth.times[i]});
    recording->colors_.resize(recording->files_.size());
    if (!index->color.images.empty()) {
      recording->colors_ =
          nearest_colors(index->color, recording->files_, params.time_window, info.notes);
    }
    return std::unique_ptr<Recording>(std::move(recording));
  }

  std::size_t size() const override { return files_.size(); }

  Result<RecordedFrame> read(std::size_t i) override {
    auto frame = read_depth(files_[i].image);
    if (!frame) return frame;
    frame->time = files_[i].time;
    auto color = read_color(colors_[i]);
    if (!color) return color.error();
    frame->color = *std::move(color);
    return frame;
  }

 private:
  Result<RecordedFrame> read_depth(const fs::path& path) const {
    const auto file = read_file(path);
    if (!file) return file.error();
    Cursor cursor(file->text(), path.string());
    const Camera& camera = *info_.camera.camera;
    const std::size_t pixels = std::size_t{camera.width} * camera.height;
    std::uint32_t width = 0, height = 0, largest = 0;
    const bool head = cursor.word() == "P5" && cursor.number(width) && cursor.number(height) &&
                      cursor.number(largest) && cursor.at_line_end();
    cursor.next_line();
    if (!head || width != camera.width || height != camera.height ||
        cursor.remaining() != 2 * pixels) {
      return cursor.byte_error(fmt::format("a line 'P5 {} {} 65535' and then {} bytes are expected",
                                           camera.width, camera.height, 2 * pixels));
    }
    RecordedFrame frame{width, height, std::vector<std::uint16_t>(pixels)};
    std::memcpy(frame.depth.data(), cursor.take(2 * pixels), 2 * pixels);
    for (std::size_t p = 0; p < pixels; ++p) {
      if (frame.depth[p] >= kDisparities) {
        return cursor.byte_error(
            fmt::format("pixel {} has the raw value {}, 11 bits are expected", p, frame.depth[p]));
      }
      frame.depth[p] = depths_[frame.depth[p]];
    }
    return frame;
  }

  std::vector<FrameFile> files_;
  std::vector<ColorFile> colors_;
  std::array<std::uint16_t, kDisparities> depths_{};  ///< of every raw value, in kUnit
};

}  // namespace

RecordingFormat fakenect_format() {
  return {"fakenect", "dump of libfreenect's record (INDEX.txt, d-*.pgm, r-*.ppm)",
          recognise_fakenect, FakenectRecording::open};
}

}  // namespace burnish
