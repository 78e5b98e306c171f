#pragma once

#include <span>
#include <string>
#include <string_view>

#include "burnish/base/result.h"
#include "burnish/core/depth_frame.h"

namespace burnish {

/// A kind of depth camera: its geometry, its noise, and what else a simulation of it needs.
struct Sensor {
  std::string name;
  Camera camera;
  DepthNoise noise;
  double frame_rate = 30;     ///< 1/s
  double disparity_step = 0;  ///< 1/m: 1/z is a multiple of it; 0: depth is continuous
  double projector = 0;       ///< m, the projector's place along the camera's x axis; 0: none apart

  friend bool operator==(const Sensor&, const Sensor&) = default;
};

/// The sensors known by name:
///
/// kinect_v1     640x480, 57 x 47 degrees (fx = 589.4, fy = 552.0) and 30 fps as Ozbay and Cinar
///               state for their scanner, 0.4 to 4.5 m. (A real device has square pixels, about
///               fx = fy = 585, 57 x 45 degrees: name that camera for frames of one.) Noise:
///               Nguyen, Izadi and Lovell, "Modeling Kinect sensor noise for improved 3D
///               reconstruction and tracking", 3DIMPVT 2012: axial 0.0012 + 0.0019 (z - 0.4)^2,
///               beyond 60 degrees + 0.0001 / sqrt(z) theta^2 / (pi/2 - theta)^2; lateral 0.8 +
///               0.035 theta / (pi/2 - theta) pixels. Disparity steps: Khoshelham and Elberink,
///               "Accuracy and resolution of Kinect depth data", Sensors 12, 2012: dz = 2.85e-3 z^2
///               m. The projector stands 75 mm to the camera's right.
/// primesense    the same device (Kinect v1, Xtion, Carmine) as ROS, TUM RGB-D and Open3D describe
///               frames of unknown calibration: fx = fy = 525, c = (319.5, 239.5).
/// kinect_v2     512x424, 70 x 60 degrees (fx = fy = 365), 30 fps, 0.5 to 4.5 m. Noise: Fankhauser,
///               Bloesch, Rodriguez, Kaestner, Hutter and Siegwart, "Kinect v2 for mobile robot
///               navigation: evaluation and modeling", ICAR 2015: axial (mm) 1.5 - 0.5 z + 0.3 z^2
///               + 0.1 z^1.5 theta^2 / (pi/2 - theta)^2; lateral 1.6 mm. The constants were quoted
///               from secondary sources, not checked against the paper.
/// azure_kinect  640x576, 75 x 65 degrees (fx = fy = 504, narrow unbinned mode), 30 fps, 0.5 to
///               3.86 m. No formula is published. Axial: the line through the 1 mm at 1 m and 2 mm
///               at 2.5 m that Toelgyessy, Dekan, Chovanec and Hubinsky report ("Evaluation of the
///               Azure Kinect and its comparison to Kinect v1 and v2", Sensors 21, 2021); Microsoft
///               promises no more than 17 mm. Lateral: as kinect_v2, for want of a measurement.
/// pinhole       640x480, 60 degrees wide; no noise, no limit of range.
std::span<const Sensor> sensors();

/// Errors: invalid_argument that lists the known names.
Result<Sensor> find_sensor(std::string_view name);

}  // namespace burnish
