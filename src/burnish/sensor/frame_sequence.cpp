#include "burnish/sensor/frame_sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "burnish/sensor/camera_file.h"
#include "burnish/sensor/frame_layout.h"

namespace burnish {
namespace fs = std::filesystem;
namespace {

constexpr float kSaturated = 65535;  ///< what cameras write for "too far" or "unknown"

/// The preset that frames of this size most likely come from.
std::optional<Sensor> sensor_for_size(std::uint32_t width, std::uint32_t height) {
  for (const char* name : {"primesense", "kinect_v2", "azure_kinect"}) {
    const Sensor sensor = find_sensor(name).value();
    if (sensor.camera.width == width && sensor.camera.height == height) return sensor;
  }
  return std::nullopt;
}

Result<Sensor> choose_sensor(const std::string& name, const DepthImage& image,
                             std::vector<std::string>& notes) {
  if (!name.empty()) return find_sensor(name);
  const auto sensor = sensor_for_size(image.width, image.height);
  const Sensor chosen = sensor ? *sensor : find_sensor("primesense").value();
  notes.push_back(fmt::format("no sensor is named: noise and range are those of {}", chosen.name));
  return chosen;
}

Result<Camera> choose_camera(const FrameOptions& options, const CameraFile& beside,
                             const Sensor& sensor, const DepthImage& image,
                             std::vector<std::string>& notes) {
  const bool known = options.camera || beside.camera;
  Camera camera = options.camera ? *options.camera : beside.camera ? *beside.camera : sensor.camera;
  if (known && camera.width == 0) camera.width = image.width;
  if (known && camera.height == 0) camera.height = image.height;
  if (camera.width != image.width || camera.height != image.height) {
    return Error{
        ErrorCode::invalid_argument,
        fmt::format("the first depth image has {} x {} pixels, the camera {} {} x {}: give "
                    "the camera of these images as fx,fy,cx,cy",
                    image.width, image.height, known ? "given" : "of " + sensor.name, camera.width,
                    camera.height),
        {}};
  }
  if (auto sound = check(camera); !sound) return sound.error();
  if (!known) {
    notes.push_back(
        fmt::format("no camera is given: fx={:.6g} fy={:.6g} cx={:.6g} cy={:.6g} of {} "
                    "are assumed",
                    camera.fx, camera.fy, camera.cx, camera.cy, sensor.name));
  }
  return camera;
}

/// Looks for camera.txt, then for camera-intrinsics.txt.
Result<CameraFile> find_camera(const FrameLayout& layout) {
  const auto path = find_beside(layout, {"camera.txt", "camera-intrinsics.txt"});
  return path ? read_camera_file(*path) : CameraFile{};
}

}  // namespace

double default_depth_scale(const DepthImage& image) {
  return image.integer ? 0.001 : 1;
}

Result<DepthFrame> FrameSequence::read(std::size_t i) const {
  const FrameFile& file = files_[i];
  const auto image = read_depth_image(file.image);
  if (!image) return image.error();
  if (image->width != camera_.width || image->height != camera_.height) {
    return Error{ErrorCode::bad_file,
                 fmt::format("the image has {} x {} pixels, the camera {} x {}", image->width,
                             image->height, camera_.width, camera_.height),
                 file.image.string()};
  }
  DepthFrame frame{
      camera_, {}, file.T_world_camera.value_or(RigidTransform{}), sensor_.noise, file.time};
  const double scale = depth_scale_.value_or(default_depth_scale(*image));
  const double nearest = std::max(sensor_.noise.min_depth, 0.0);
  const double farthest =
      sensor_.noise.max_depth > 0 ? sensor_.noise.max_depth : std::numeric_limits<float>::max();
  frame.depth.reserve(image->values.size());
  for (const float value : image->values) {
    const double z = value * scale;
    const bool measured =
        value > 0 && !(image->integer && value == kSaturated) && z >= nearest && z <= farthest;
    frame.depth.push_back(measured ? static_cast<float>(z) : 0.f);
  }
  return frame;
}

FrameSequence FrameSequence::with_poses(
    std::span<const std::optional<RigidTransform>> T_world_camera) const {
  FrameSequence posed = *this;
  for (std::size_t i = 0; i < size(); ++i) posed.files_[i].T_world_camera = T_world_camera[i];
  std::erase_if(posed.files_, [](const FrameFile& file) { return !file.T_world_camera; });
  posed.has_poses_ = true;
  return posed;
}

Result<FrameSequence> open_frames(const std::vector<fs::path>& inputs,
                                  const FrameOptions& options) {
  if (options.depth_scale && !(*options.depth_scale > 0 && std::isfinite(*options.depth_scale))) {
    return Error{
        ErrorCode::invalid_argument,
        fmt::format("depth_scale is {}, metres per unit are expected", *options.depth_scale),
        {}};
  }
  const auto layout = find_frames(inputs);
  if (!layout) return layout.error();
  FrameSequence sequence;
  sequence.files_ = files_of(*layout);
  const auto posed =
      find_poses(*layout, options.poses, kTimeWindow, sequence.files_, sequence.notes_);
  if (!posed) return posed.error();
  sequence.has_poses_ = *posed;

  const auto beside = find_camera(*layout);
  if (!beside) return beside.error();
  const auto first = read_depth_image(sequence.files_.front().image);
  if (!first) return first.error();
  const std::string& named = options.sensor.empty() ? beside->sensor : options.sensor;
  const auto sensor = choose_sensor(named, *first, sequence.notes_);
  if (!sensor) return sensor.error();
  sequence.sensor_ = *sensor;
  auto camera = choose_camera(options, *beside, *sensor, *first, sequence.notes_);
  if (!camera) {
    camera.error().where = sequence.files_.front().image.string();
    return camera.error();
  }
  sequence.camera_ = *camera;
  sequence.depth_scale_ = options.depth_scale ? options.depth_scale : beside->depth_scale;
  if (!sequence.depth_scale_ && layout->tum) sequence.depth_scale_ = kTumDepthScale;
  return sequence;
}

}  // namespace burnish
