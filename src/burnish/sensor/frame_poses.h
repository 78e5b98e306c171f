#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "burnish/base/result.h"
#include "burnish/base/rigid.h"
#include "burnish/sensor/frame_layout.h"

namespace burnish {

/// Seconds that an image and what belongs to it may be apart, as TUM's own tool has it.
inline constexpr double kTimeWindow = 0.02;

/// A depth image on disk and what is known of it.
struct FrameFile {
  std::filesystem::path image;
  std::optional<RigidTransform> T_world_camera;
  double time = 0;  ///< s
};

/// The images of a layout, without poses.
std::vector<FrameFile> files_of(const FrameLayout& layout);

/// Gives `files` their poses, as open_frames describes; false where there are none to be found.
/// `given`: a pose list, or empty. `window` (s): how far apart an image and its pose may be where
/// both have timestamps; images without one are taken out of `files`, with a note.
Result<bool> find_poses(const FrameLayout& layout, const std::filesystem::path& given,
                        double window, std::vector<FrameFile>& files,
                        std::vector<std::string>& notes);

}  // namespace burnish
