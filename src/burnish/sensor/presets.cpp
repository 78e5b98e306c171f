#include "burnish/sensor/presets.h"

#include <fmt/format.h>

#include <numbers>
#include <vector>

namespace burnish {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

DepthNoise nguyen_2012() {
  return {.z0 = 0.4,
          .c0 = 0.0012,
          .c2 = 0.0019,
          .grazing = 0.0001,
          .power = -0.5,
          .grazing_from = 60 * kDegree,
          .pixels = 0.8,
          .pixels_grazing = 0.035,
          .min_depth = 0.4,
          .max_depth = 4.5};
}

DepthNoise fankhauser_2015() {
  return {.c0 = 0.0015,
          .c1 = -0.0005,
          .c2 = 0.0003,
          .grazing = 0.0001,
          .power = 1.5,
          .metres = 0.0016,
          .min_depth = 0.5,
          .max_depth = 4.5};
}

DepthNoise toelgyessy_2021() {
  return {.z0 = 1,
          .c0 = 0.001,
          .c1 = 0.001 / 1.5,
          .metres = 0.0016,
          .min_depth = 0.5,
          .max_depth = 3.86};
}

constexpr double kKinectStep = 2.85e-3;    ///< 1/m, Khoshelham and Elberink 2012
constexpr double kKinectBaseline = 0.075;  ///< m

std::vector<Sensor> make_sensors() {
  return {
      {.name = "kinect_v1",
       .camera = {640, 480, 589.3666835307065, 551.9622113367017, 319.5, 239.5},
       .noise = nguyen_2012(),
       .disparity_step = kKinectStep,
       .projector = kKinectBaseline},
      {.name = "primesense",
       .camera = {640, 480, 525, 525, 319.5, 239.5},
       .noise = nguyen_2012(),
       .disparity_step = kKinectStep,
       .projector = kKinectBaseline},
      {.name = "kinect_v2",
       .camera = {512, 424, 365, 365, 255.5, 211.5},
       .noise = fankhauser_2015()},
      {.name = "azure_kinect",
       .camera = {640, 576, 504, 504, 319.5, 287.5},
       .noise = toelgyessy_2021()},
      {.name = "pinhole",
       .camera = {640, 480, 554.2562584220408, 554.2562584220408, 319.5, 239.5},
       .noise = {}},
  };
}

}  // namespace

std::span<const Sensor> sensors() {
  static const std::vector<Sensor> all = make_sensors();
  return all;
}

Result<Sensor> find_sensor(std::string_view name) {
  std::string known;
  for (const Sensor& sensor : sensors()) {
    if (sensor.name == name) return sensor;
    known += (known.empty() ? "" : ", ") + sensor.name;
  }
  return Error{
      ErrorCode::invalid_argument, fmt::format("unknown sensor '{}', known: {}", name, known), {}};
}

}  // namespace burnish
