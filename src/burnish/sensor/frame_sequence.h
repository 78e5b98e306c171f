#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "burnish/base/result.h"
#include "burnish/core/depth_frame.h"
#include "burnish/io/depth_image.h"
#include "burnish/sensor/frame_poses.h"
#include "burnish/sensor/presets.h"

namespace burnish {

/// What the caller knows of the frames; what is left open is looked for beside them.
struct FrameOptions {
  std::filesystem::path poses{};   ///< a pose list (sensor/pose_list.h)
  std::optional<Camera> camera{};  ///< width and height 0: those of the frames
  std::string sensor{};            ///< a name for find_sensor: noise, range, camera of last resort
  std::optional<double> depth_scale{};  ///< metres per unit of the images
};

/// Depth frames that lie in files and are read one at a time. Cheap to copy; read() may be called
/// from many threads.
class FrameSequence {
 public:
  std::size_t size() const { return files_.size(); }
  bool has_poses() const { return has_poses_; }
  const Camera& camera() const { return camera_; }
  const Sensor& sensor() const { return sensor_; }
  const std::vector<FrameFile>& files() const { return files_; }
  /// The file name of frame `i` without its folder.
  std::string name(std::size_t i) const { return files_[i].image.filename().string(); }
  /// What was assumed or left out, one sentence each, for whoever reads the result.
  const std::vector<std::string>& notes() const { return notes_; }

  /// Frame `i` < size(), in metres. 0, the 65535 of integer images, NaN and depths out of the
  /// sensor's range become 0, "no depth". Frames without a pose stand at the origin. Errors: those
  /// of read_depth_image, bad_file where the image has not the camera's size; they name the file.
  Result<DepthFrame> read(std::size_t i) const;

  /// The frames that have a pose in `T_world_camera` (size() of them), with these poses.
  FrameSequence with_poses(std::span<const std::optional<RigidTransform>> T_world_camera) const;

 private:
  friend Result<FrameSequence> open_frames(const std::vector<std::filesystem::path>&,
                                           const FrameOptions&);

  std::vector<FrameFile> files_;
  bool has_poses_ = false;
  Camera camera_;
  Sensor sensor_;
  std::optional<double> depth_scale_;  ///< none: see default_depth_scale
  std::vector<std::string> notes_;
};

/// 0.001 (millimetres) for images of whole numbers, 1 (metres) for images of floats.
double default_depth_scale(const DepthImage& image);

/// Opens one folder of depth images, or images named one by one (in that order).
///
/// Images. In a folder: PNG, PGM and TIFF in natural order (frame 9 before frame 10); where some
/// names hold "depth", only those; where there are none, those in its subfolder `depth`; where
/// there is a depth.txt (TUM RGB-D: `timestamp file` lines), those that it lists. Poses.
/// options.poses; or NAME.pose.txt beside every NAME.depth.png (7-Scenes); or, for a folder, the
/// first of pose.txt, poses.txt, trajectory.log, trajectory.txt and groundtruth.txt in it, or above
/// a folder called `depth`. There must be as many poses as images; only where both have timestamps
/// is each image given the nearest pose within 20 ms, and images without one are left out with a
/// note. Camera. options.camera; or camera.txt or camera-intrinsics.txt beside; or the sensor's;
/// or, with a note, that of the preset with frames of this size. Sensor. options.sensor, or the one
/// camera.txt names, or the preset with frames of this size. Depth scale. options.depth_scale; or
/// camera.txt's; or 1/5000 with a depth.txt of TUM; or default_depth_scale.
///
/// Reads the first image and all poses, no other image. Errors: not_found, io_failure, bad_file,
/// unsupported, invalid_argument; they name the file, and the line where it has lines.
Result<FrameSequence> open_frames(const std::vector<std::filesystem::path>& inputs,
                                  const FrameOptions& options = {});

}  // namespace burnish
