#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "burnish/sensor/frame_sequence.h"

namespace burnish::app {

/// What the user said of frames, as typed.
struct FrameTexts {
  std::string poses, camera, sensor, depth_scale;
};

/// Adds --poses, --camera, --sensor and --depth_scale to a verb.
void add_frame_options(CLI::App* verb, FrameTexts& texts);

/// The same without --poses.
void add_camera_options(CLI::App* verb, FrameTexts& texts);

/// Errors: invalid_argument.
Result<FrameOptions> read_frame_texts(const FrameTexts& texts);

/// "kinect_v1, kinect_v2, ...".
std::string sensor_names();

}  // namespace burnish::app
