#pragma once

#include <filesystem>
#include <string>

#include "burnish/base/result.h"
#include "burnish/sensor/camera_file.h"
#include "burnish/sensor/recorded_frame.h"
#include "burnish/sensor/staging_folder.h"

namespace burnish {

/// Writes frames to a folder as open_frames reads them and simulate_turntable writes them:
///   frame-000000.depth.png, ...      16-bit PNG in the unit that camera.txt states
///   frame-000000.color.png or .jpg   where there is a colour image
///   frame-000000.pose.txt            camera to world, 4x4, where there is a pose
///   camera.txt, and camera-intrinsics.txt where the camera is known
///   depth.txt, rgb.txt               TUM's lists `timestamp file`, where there are timestamps
///   recording.json                   what the recording said
/// They appear in the folder all at once (StagingFolder).
class FrameFolder {
 public:
  /// The folder may be new, empty, or hold an earlier recording, which finish() replaces. Errors:
  /// invalid_argument, io_failure; they name the folder.
  static Result<FrameFolder> create(const std::filesystem::path& folder);

  /// Errors: invalid_argument where the depth has not width * height values, io_failure.
  Result<void> add(const RecordedFrame& frame);

  /// `camera` must have a depth scale; one of no size has that of the frames.
  Result<void> finish(CameraFile camera, const std::string& json);

 private:
  explicit FrameFolder(StagingFolder staging) : staging_(std::move(staging)) {}

  StagingFolder staging_;
  std::size_t frames_ = 0;
  std::uint32_t width_ = 0, height_ = 0;
  std::string depth_list_, color_list_;
};

}  // namespace burnish
