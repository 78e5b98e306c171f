#include "burnish/sensor/recording_azure.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "burnish/io/depth_image.h"
#include "burnish/sensor/color_image.h"
#include "burnish/sensor/lens.h"
#include "burnish/sensor/matroska.h"
#include "burnish/sensor/nearest_time.h"

namespace burnish {
namespace {

/// Of a depth mode: its images, the side of the square image that they are cut from, and where.
/// (Azure-Kinect-Sensor-SDK, k4a_calibration_get_camera.)
struct DepthMode {
  std::uint32_t width, height;
  double side, left, top;
};
constexpr std::array<DepthMode, 4> kModes{{{640, 576, 1024, 192, 180},
                                           {320, 288, 512, 96, 90},
                                           {1024, 1024, 1024, 0, 0},
                                           {512, 512, 512, 0, 0}}};

struct Calibration {
  Camera camera;
  Lens lens;
};

/// What calibration.json says of the depth camera.
Result<Calibration> read_calibration(std::string_view text, std::uint32_t width,
                                     std::uint32_t height, const std::string& where) {
  const auto damaged = [&](const char* message) {
    return Error{ErrorCode::bad_file, message, where};
  };
  const DepthMode* mode = nullptr;
  for (const DepthMode& known : kModes) {
    if (known.width == width && known.height == height) mode = &known;
  }
  if (!mode) return damaged("the depth images have the size of no mode of an Azure Kinect");
  const auto json = nlohmann::json::parse(text.substr(0, text.find('\0')), nullptr, false);
  const nlohmann::json::json_pointer cameras("/CalibrationInformation/Cameras");
  if (!json.contains(cameras) || !json[cameras].is_array())
    return damaged("CalibrationInformation.Cameras are expected");
  const nlohmann::json::json_pointer params("/Intrinsics/ModelParameters");
  for (const auto& camera : json[cameras]) {
    if (!camera.is_object() ||
        camera.value("/Location"_json_pointer, nlohmann::json()) != "CALIBRATION_CameraLocationD0")
      continue;
    std::array<double, 14> n{};  // cx cy fx fy k1 ... k6, the centre of distortion, p2 p1
    if (!camera.contains(params) || !camera[params].is_array() || camera[params].size() < n.size())
      return damaged("14 ModelParameters of the depth camera are expected");
    for (std::size_t i = 0; i < n.size(); ++i) {
      const auto& value = camera[params][i];
      if (!value.is_number()) return damaged("a ModelParameter is no number");
      n[i] = value.get<double>();
      if (!std::isfinite(n[i])) return damaged("a ModelParameter is not finite");
    }
    // Shares of the square image, measured from the corner of its first pixel.
    Calibration result{{width, height, n[2] * mode->side, n[3] * mode->side,
                        n[0] * mode->side - mode->left - 0.5, n[1] * mode->side - mode->top - 0.5},
                       {{n[4], n[5], n[6], n[7], n[8], n[9]}, n[13], n[12]}};
    if (auto sound = check(result.camera); !sound) return damaged("the camera cannot be");
    return result;
  }
  return damaged("the depth camera is expected among CalibrationInformation.Cameras");
}

class AzureRecording : public Recording {
 public:
  AzureRecording(std::string name, FileBytes owner)
      : name_(std::move(name)), owner_(std::move(owner)) {}

  Result<void> open(std::string_view bytes, const ImportParams& params) {
    auto file = read_matroska(bytes, name_);
    if (!file) return file.error();
    file_ = *std::move(file);
    depth_ = track("K4A_DEPTH_TRACK", "DEPTH");
    if (!depth_) return error(0, "no track is called DEPTH", ErrorCode::unsupported);
    if (depth_->codec != "V_MS/VFW/FOURCC" || depth_->fourcc != "b16g" || depth_->packed) {
      return error(
          0,
          fmt::format("the depth is {} {}, plain b16g is expected", depth_->codec, depth_->fourcc),
          ErrorCode::unsupported);
    }
    if (depth_->width == 0 || depth_->height == 0 || depth_->width > kMaxDepthPixels ||
        depth_->height > kMaxDepthPixels / depth_->width) {
      return error(0, fmt::format("the depth images are claimed to have {} x {} pixels",
                                  depth_->width, depth_->height));
    }
    if (depth_->blocks.empty()) return error(0, "there is no depth image in it");
    info_.camera = {{}, 0.001, "azure_kinect"};
    info_.registered = false;
    for (const auto& [key, text] : file_.tags) info_.said.emplace_back(key, text);
    if (auto calibrated = calibrate(); !calibrated) return calibrated;
    find_colors(params.time_window);
    return {};
  }

  std::size_t size() const override { return depth_->blocks.size(); }

  Result<RecordedFrame> read(std::size_t i) override {
    const MatroskaBlock& block = depth_->blocks[i];
    RecordedFrame frame{
        static_cast<std::uint32_t>(depth_->width), static_cast<std::uint32_t>(depth_->height), {}};
    const std::size_t pixels = std::size_t{frame.width} * frame.height;
    if (block.bytes.size() != 2 * pixels) {
      return error(block.at, fmt::format("frame {} has {} bytes, {} x {} x 2 are expected", i,
                                         block.bytes.size(), frame.width, frame.height));
    }
    frame.depth.resize(pixels);
    for (std::size_t p = 0; p < pixels; ++p) {
      const std::size_t source = sources_.empty() ? p : sources_[p];
      if (source == pixels) continue;
      frame.depth[p] =
          static_cast<std::uint16_t>(static_cast<unsigned char>(block.bytes[2 * source]) << 8 |
                                     static_cast<unsigned char>(block.bytes[2 * source + 1]));
    }
    frame.time = seconds(block);
    if (const MatroskaBlock* color = colors_[i]) {
      if (!is_jpeg(color->bytes)) {
        return error(color->at, fmt::format("the colour image of frame {} is no JPEG", i));
      }
      frame.color = {std::string(color->bytes), ".jpg", seconds(*color)};
    }
    return frame;
  }

 private:
  static double seconds(const MatroskaBlock& block) {
    return static_cast<double>(block.nanoseconds) / 1e9;
  }

  Error error(std::size_t at, std::string message, ErrorCode code = ErrorCode::bad_file) const {
    return {code, std::move(message), fmt::format("{}, byte {}", name_, at)};
  }

  std::string tag(std::string_view name) const {
    for (const auto& [key, text] : file_.tags) {
      if (key == name) return text;
    }
    return {};
  }

  /// The track whose UID the tag tells, or which is called so.
  const MatroskaTrack* track(std::string_view tag_name, std::string_view name) const {
    const std::string uid = tag(tag_name);
    for (const MatroskaTrack& track : file_.tracks) {
      if (uid.empty() ? track.name == name : fmt::format("{}", track.uid) == uid) return &track;
    }
    return nullptr;
  }

  Result<void> calibrate() {
    std::string wanted = tag("K4A_CALIBRATION_FILE");
    if (wanted.empty()) wanted = "calibration.json";
    for (const auto& [attached, text] : file_.attachments) {
      if (attached != wanted) continue;
      const auto calibration = read_calibration(text, static_cast<std::uint32_t>(depth_->width),
                                                static_cast<std::uint32_t>(depth_->height),
                                                fmt::format("{}, attachment {}", name_, attached));
      if (!calibration) return calibration.error();
      info_.camera.camera = calibration->camera;
      sources_ = undistortion(calibration->camera, calibration->lens);
      info_.notes.push_back("the lens's distortion was taken out of the depth images");
      return {};
    }
    info_.notes.push_back(
        "there is no calibration: the lens's distortion stays in the depth images");
    return {};
  }

  void find_colors(double window) {
    colors_.resize(depth_->blocks.size());
    const MatroskaTrack* color = track("K4A_COLOR_TRACK", "COLOR");
    if (!color) return;
    const bool jpeg = color->codec == "V_MJPEG" || color->fourcc == "MJPG";
    if (!jpeg || color->packed) {
      info_.notes.push_back(
          fmt::format("colour images of kind {} {} are left out", color->codec, color->fourcc));
      return;
    }
    std::vector<double> times;
    for (const MatroskaBlock& block : color->blocks) times.push_back(seconds(block));
    const NearestTime nearest(std::move(times));
    for (std::size_t i = 0; i < colors_.size(); ++i) {
      const auto found = nearest.find(seconds(depth_->blocks[i]), window);
      if (found) colors_[i] = &color->blocks[*found];
    }
  }

  std::string name_;
  FileBytes owner_;
  Matroska file_;
  const MatroskaTrack* depth_ = nullptr;
  std::vector<const MatroskaBlock*> colors_;  ///< of each depth image, null: none
  std::vector<std::uint32_t> sources_;        ///< as undistortion() gives them; empty: none
};

bool recognise_azure(const RecordingPlace& place) {
  return !place.is_folder && recognise_matroska(place.bytes);
}

Result<std::unique_ptr<Recording>> open_azure_file(const std::filesystem::path& path,
                                                   const ImportParams& params) {
  auto file = map_file(path);
  if (!file) return file.error();
  const std::string_view bytes = file->text();
  return open_azure(bytes, path.string(), params, *std::move(file));
}

}  // namespace

Result<std::unique_ptr<Recording>> open_azure(std::string_view bytes, const std::string& name,
                                              const ImportParams& params, FileBytes owner) {
  auto recording = std::make_unique<AzureRecording>(name, std::move(owner));
  if (auto opened = recording->open(bytes, params); !opened) return opened.error();
  return std::unique_ptr<Recording>(std::move(recording));
}

RecordingFormat azure_format() {
  return {"azure", "Azure Kinect's recorder (Matroska)", recognise_azure, open_azure_file};
}

}  // namespace burnish
