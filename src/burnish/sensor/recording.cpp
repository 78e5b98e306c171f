#include "burnish/sensor/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "burnish/io/file.h"
#include "burnish/sensor/frame_folder.h"
#include "burnish/sensor/recording_format.h"

namespace burnish {
namespace fs = std::filesystem;
namespace {

constexpr std::uint16_t kSaturated = 65535;  ///< what cameras write for "too far" or "unknown"

struct OpenRecording {
  const RecordingFormat* format;
  std::unique_ptr<Recording> recording;
};

Result<OpenRecording> open_recording(const fs::path& path, const ImportParams& params) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) {
    return Error{ErrorCode::not_found, "there is no such file or folder", path.string()};
  }
  RecordingPlace place{path, fs::is_directory(path, ignored), {}};
  if (place.is_folder && fs::exists(path / "recording.json", ignored)) {
    return Error{ErrorCode::invalid_argument,
                 "a recording was imported to this folder, which burnish reads as it is",
                 path.string()};
  }
  FileBytes file;
  if (!place.is_folder) {
    auto mapped = map_file(path);
    if (!mapped) return mapped.error();
    file = *std::move(mapped);
    place.bytes = file.text();
  }
  std::string known;
  for (const RecordingFormat& format : recording_formats()) {
    if (format.recognises(place)) {
      auto recording = format.open(path, params);
      if (!recording) return recording.error();
      return OpenRecording{&format, *std::move(recording)};
    }
    known += fmt::format("{}{}", known.empty() ? "" : "; ", format.title);
  }
  return Error{ErrorCode::unsupported,
               fmt::format("this {} is no recording of a known kind ({})",
                           place.is_folder ? "folder" : "file", known),
               path.string()};
}

/// What is said of the camera, what is given going first.
CameraFile joined(const CameraFile& given, CameraFile said) {
  if (given.camera) said.camera = given.camera;
  if (given.depth_scale) said.depth_scale = given.depth_scale;
  if (!given.sensor.empty()) said.sensor = given.sensor;
  return said;
}

/// Errors: invalid_argument where the camera is not one for frames of this size.
Result<void> check_camera(const CameraFile& file, const RecordedFrame& frame) {
  if (!file.camera) return {};
  Camera camera = *file.camera;
  if (camera.width == 0) camera.width = frame.width;
  if (camera.height == 0) camera.height = frame.height;
  if (camera.width != frame.width || camera.height != frame.height) {
    return Error{ErrorCode::invalid_argument,
                 fmt::format("the depth images have {} x {} pixels, their camera {} x {}",
                             frame.width, frame.height, camera.width, camera.height),
                 {}};
  }
  if (auto sound = check(camera); !sound) {
    return Error{ErrorCode::invalid_argument, sound.error().message, {}};
  }
  return {};
}

/// Counts and compares the frames as they come.
class Census {
 public:
  /// Errors: bad_file where the frame's size is not the first one's; the caller knows the place.
  Result<void> add(const RecordedFrame& frame) {
    if (report_.frames == 0) {
      width_ = frame.width;
      height_ = frame.height;
    } else if (frame.width != width_ || frame.height != height_) {
      return Error{ErrorCode::bad_file,
                   fmt::format("the depth image has {} x {} pixels, the first one {} x {}",
                               frame.width, frame.height, width_, height_),
                   {}};
    }
    ++report_.frames;
    report_.color_images += !frame.color.bytes.empty();
    report_.posed_frames += frame.T_world_camera.has_value();
    pixels_ += frame.depth.size();
    for (const std::uint16_t depth : frame.depth) measured_ += depth != 0 && depth != kSaturated;
    if (frame.time && last_time_ && *frame.time <= *last_time_) ++late_;
    last_time_ = frame.time;
    return {};
  }

  ImportReport report(const RecordingFormat& format, std::vector<std::string> notes,
                      bool poses_wanted) && {
    report_.format = format.title;
    report_.notes = std::move(notes);
    report_.measured_share = double(measured_) / double(std::max<std::size_t>(pixels_, 1));
    if (late_ > 0) {
      report_.notes.push_back(fmt::format(
          "the timestamps of {} frames are not after those of the frames before", late_));
    }
    if (poses_wanted && report_.posed_frames == 0) report_.notes.push_back("no frame has a pose");
    return std::move(report_);
  }

 private:
  ImportReport report_;
  std::uint32_t width_ = 0, height_ = 0;
  std::size_t pixels_ = 0, measured_ = 0, late_ = 0;
  std::optional<double> last_time_;
};

std::string summary_json(const fs::path& source, std::string_view format, const RecordingInfo& info,
                         const CameraFile& camera, const ImportParams& params,
                         const ImportReport& report) {
  nlohmann::ordered_json json;
  json["source"] = (source.has_filename() ? source : source.parent_path()).filename().string();
  json["format"] = format;
  for (const auto& [key, value] : ImportParams::schema().settings(params))
    json["params"][key] = value;
  json["camera_known"] = camera.camera.has_value();
  json["depth_scale"] = *camera.depth_scale;
  json["color_registered"] =
      info.registered ? nlohmann::ordered_json(*info.registered) : nlohmann::ordered_json();
  for (const auto& [key, value] : info.said) json["said"][key] = value;
  for (const Fact& fact : report.facts()) json["result"][fact.key] = fact.value;
  json["notes"] = report.notes;
  // Names in foreign files need not be UTF-8.
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

const Schema<ImportParams>& ImportParams::schema() {
  using P = ImportParams;
  static const auto schema =
      Schema<P>()
          .integer("every", &P::every, between(1, 1000000), "of so many frames one is taken")
          .integer("frames", &P::frames, between(0, std::numeric_limits<int>::max()),
                   "at most so many are taken; 0 takes all")
          .flag("poses", &P::poses,
                "take the poses over, and only frames that have one; false takes all frames")
          .real("time_window", &P::time_window, at_least(0),
                "between a depth image and its colour image or pose", Quantity::time);
  return schema;
}

Facts ImportReport::facts() const {
  return {{"frames", double(frames), ""},
          {"color_images", double(color_images), ""},
          {"posed_frames", double(posed_frames), ""},
          {"measured_share", measured_share, ""}};
}

const std::vector<RecordingFormat>& recording_formats() {
  static const std::vector<RecordingFormat> all{oni_format(),   azure_format(),    pclzf_format(),
                                                klg_format(),   fakenect_format(), tum_format(),
                                                images_format()};
  return all;
}

std::vector<RecordingTitle> recording_titles() {
  std::vector<RecordingTitle> titles;
  for (const RecordingFormat& format : recording_formats())
    titles.push_back({format.name, format.title});
  return titles;
}

Result<ImportReport> import_recording(const fs::path& path, const fs::path& folder,
                                      const ImportParams& params, const CameraFile& given,
                                      const Context& context) {
  if (auto valid = ImportParams::schema().check(params); !valid) return valid.error();
  auto open = open_recording(path, params);
  if (!open) return open.error();
  Recording& recording = *open->recording;
  auto frames = FrameFolder::create(folder);
  if (!frames) return frames.error();

  const std::size_t step = static_cast<std::size_t>(params.every);
  std::size_t count = (recording.size() + step - 1) / step;
  if (params.frames > 0) count = std::min(count, static_cast<std::size_t>(params.frames));
  Census census;
  CameraFile camera = given;
  for (std::size_t i = 0; i < count; ++i) {
    if (context.cancelled()) return cancelled();
    auto frame = recording.read(i * step);
    if (!frame) return frame.error();
    if (!params.poses) frame->T_world_camera.reset();
    if (auto counted = census.add(*frame); !counted) {
      counted.error().where = fmt::format("{}, frame {}", path.string(), i * step);
      return counted.error();
    }
    if (i == 0) {
      camera = joined(given, recording.info().camera);
      if (auto fits = check_camera(camera, *frame); !fits) return fits.error();
    }
    if (auto added = frames->add(*frame); !added) return added.error();
    context.progress(double(i + 1) / double(count));
  }
  const RecordingInfo& info = recording.info();
  ImportReport report = std::move(census).report(*open->format, info.notes, params.poses);
  const std::string json = summary_json(path, open->format->name, info, camera, params, report);
  if (context.cancelled()) return cancelled();
  if (auto done = frames->finish(camera, json); !done) return done.error();
  return report;
}

}  // namespace burnish
