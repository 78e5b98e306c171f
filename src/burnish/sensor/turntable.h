#pragma once

#include <filesystem>

#include "burnish/base/context.h"
#include "burnish/base/facts.h"
#include "burnish/base/schema.h"
#include "burnish/core/triangle_mesh.h"
#include "burnish/sensor/presets.h"

namespace burnish {

struct TurntableParams {
  int views = 24;
  int seed = 1;
  double size = 0;  ///< largest extent of the model after scaling, m; 0: as it is
  double distance =
      0;  ///< from the camera to the middle of the model, m; 0: the model fills the view
  double elevation =
      0.4363323129985824;  ///< of the lowest ring of views above the horizontal, rad (25 deg)
  int rings = 2;           ///< rings of views between there and the top, visited in turn
  double noise = 1;        ///< share of the sensor's noise; 0: exact depth
  double axis_offset = 0;  ///< of the table's axis from the middle of the model, m
  double axis_tilt = 0;    ///< of the axis from the vertical, rad
  double step_jitter = 0;  ///< one standard deviation of the table's angle at every view, rad

  static const Schema<TurntableParams>& schema();
};

/// What a simulation did.
struct Simulation {
  int views = 0;
  double scale = 1;     ///< world = scale * model
  double distance = 0;  ///< m
  std::size_t measured_pixels = 0;

  Facts facts() const;
};

/// Lets a virtual camera take `views` pictures of `model` on a turntable and writes them to
/// `folder` as open_frames reads them:
///   frame-000000.depth.png, ...   16-bit PNG in mm, as a Kinect's; with noise 0
///   frame-000000.depth.tiff,
///                                 float metres, so that they stay exact
///   frame-000000.pose.txt, ...    camera to world, 4x4
///   camera-intrinsics.txt, camera.txt
///   truth/model.ply               the model, scaled, in the world of the poses
///   truth/poses.txt               x y z qx qy qz qw of every view
///   simulation.json               the parameters
/// The axis is vertical (z) through the middle of the model's box. View i looks from azimuth
/// 2 pi i / views and from ring i mod rings, ring r at elevation + r (pi/2 - elevation) / rings.
/// axis_offset and axis_tilt move the axis, in directions that the seed chooses, where the camera
/// and the model stay for the first view; step_jitter adds to every azimuth but the first.
///
/// The folder is made; one that is there must be empty or hold an earlier simulation, whose frames
/// are then replaced. On error or cancellation it is as before: pictures gather in a hidden
/// subfolder. Errors: invalid_argument (also where the model does not fit into the sensor's range),
/// bad_geometry, io_failure, cancelled.
Result<Simulation> simulate_turntable(const TriangleMesh& model, const Sensor& sensor,
                                      const TurntableParams& params,
                                      const std::filesystem::path& folder,
                                      const Context& context = {});

}  // namespace burnish
