#include "frame_options.h"

#include "burnish/base/quantity.h"
#include "burnish/sensor/camera_file.h"

namespace burnish::app {

std::string sensor_names() {
  std::string names;
  for (const Sensor& sensor : sensors()) names += (names.empty() ? "" : ", ") + sensor.name;
  return names;
}

void add_frame_options(CLI::App* verb, FrameTexts& texts) {
  verb->add_option(
      "--poses", texts.poses,
      "poses of the camera in the world: lines x y z qx qy qz qw, a TUM trajectory, or a "
      "Redwood trajectory.log; default: what lies beside the frames");
  add_camera_options(verb, texts);
}

void add_camera_options(CLI::App* verb, FrameTexts& texts) {
  auto* camera =
      verb->add_option("--camera", texts.camera, "focal lengths and principal point, pixels")
          ->type_name("fx,fy,cx,cy");
  verb->add_option("--sensor", texts.sensor, "whose camera and noise: " + sensor_names());
  verb->add_option(
          "--depth_scale", texts.depth_scale,
          "metres per unit of the depth images; default: 0.001 for whole numbers, 1 for floats")
      ->type_name("M");
  camera->description(camera->get_description() +
                      "; default: from a file beside the frames, or the sensor's");
}

Result<FrameOptions> read_frame_texts(const FrameTexts& texts) {
  FrameOptions options;
  options.poses = texts.poses;
  options.sensor = texts.sensor;
  if (!texts.sensor.empty()) {
    if (auto known = find_sensor(texts.sensor); !known) return known.error();
  }
  if (!texts.camera.empty()) {
    const Result<Camera> camera = parse_camera(texts.camera);
    if (!camera) return camera.error();
    options.camera = *camera;
  }
  if (!texts.depth_scale.empty()) {
    const Result<double> scale = parse_quantity(texts.depth_scale, Quantity::length);
    if (!scale) return scale.error();
    if (!(*scale > 0)) {
      return Error{ErrorCode::invalid_argument,
                   "--depth_scale must be positive, it is " + texts.depth_scale,
                   {}};
    }
    options.depth_scale = *scale;
  }
  return options;
}

}  // namespace burnish::app
