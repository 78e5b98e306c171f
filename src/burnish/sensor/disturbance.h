#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/sensor/presets.h"

namespace burnish {

/// What a pixel of a virtual camera sees in truth.
struct Sight {
  double depth = 0;     ///< m along +z; 0: nothing
  float incidence = 0;  ///< rad, between the surface's normal and the ray, 0 to pi/2
  bool lit = true;      ///< whether the sensor's projector reaches the point
};

/// How a picture is disturbed. `noise` scales everything that a sensor of the kind does wrong, its
/// disparity steps included: 1 is the sensor as published, 0 is exact.
struct CaptureParams {
  double noise = 1;
  std::uint64_t seed = 1;
  std::uint64_t view = 0;  ///< below 2^30; another number, another draw
};

/// Turns an image of what is there (row by row, sensor.camera's size) into one of what the sensor
/// measures; with noise 0 nothing changes but the rounding to float. In this order:
/// - Lateral: near a depth edge a pixel looks up its depth at a place shifted by the sensor's
/// lateral
///   sigma, so that outlines fray. Within a surface nothing is shifted: the published axial sigma,
///   measured on slanted planes, has that in it already.
/// - Loss: pixels that the projector does not light, a quarter of the pixels at depth edges, and
/// those
///   seen at 80 degrees or more, give or take 4 degrees in patches of a pixel or two, have no
///   depth. (The quarter, the 80 and the 4 are this project's choice after looking at Kinect
///   frames.)
/// - Axial: noise of the sensor's axial sigma, correlated between neighbouring pixels as measured
/// on a
///   real Kinect (sensor/image_noise.h), because filters tuned on white noise fail on it.
/// - Disparity steps: 1/z is rounded to a multiple of the step. The published sigma was measured
/// behind
///   those steps, so their variance is taken off the white part of the noise.
/// - Range: depths outside it become 0.
/// The same bytes for any number of threads. None where the context was cancelled.
std::optional<std::vector<float>> disturb(const Sensor& sensor, const std::vector<Sight>& sights,
                                          const CaptureParams& params, const Context& context);

}  // namespace burnish
