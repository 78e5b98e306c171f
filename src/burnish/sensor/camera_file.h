#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "burnish/base/result.h"
#include "burnish/core/depth_frame.h"

namespace burnish {

/// What a file says about the camera whose frames lie beside it. A camera of width and height 0 is
/// meant for images of whatever size the frames have.
struct CameraFile {
  std::optional<Camera> camera;
  std::optional<double> depth_scale;  ///< metres per unit of the depth images
  std::string sensor;                 ///< a name for find_sensor, or empty
};

/// Reads camera-intrinsics.txt (7-Scenes): a 3x3 matrix fx 0 cx / 0 fy cy / 0 0 1; or camera.txt:
/// lines `key value` with the keys width, height, fx, fy, cx, cy, depth_scale and sensor, the four
/// numbers of the camera all or none; # begins a comment. The number of words on the first line
/// decides. Errors: not_found, io_failure, bad_file with file and line.
Result<CameraFile> read_camera_file(const std::filesystem::path& path);

/// The text of a camera.txt; reading it back gives the same values.
std::string camera_file_text(const CameraFile& file);
/// The text of a camera-intrinsics.txt.
std::string intrinsics_text(const Camera& camera);

/// Reads "fx,fy,cx,cy" (pixels) as a camera for frames of any size. Errors: invalid_argument.
Result<Camera> parse_camera(std::string_view text);

}  // namespace burnish
