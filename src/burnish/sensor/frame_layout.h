#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "burnish/base/result.h"

namespace burnish {

/// The depth images of an input, and where to look for what belongs to them.
struct FrameLayout {
  std::vector<std::filesystem::path> images;
  std::vector<double> times;  ///< s; empty, or one per image
  std::vector<std::filesystem::path>
      folders;                ///< that may hold poses and camera, the nearest first
  bool whole_folder = false;  ///< a list of poses in `folders` is meant for all images
  bool tum = false;           ///< a depth.txt of TUM RGB-D lists the images
};

/// Metres per unit of the images that TUM RGB-D lists.
inline constexpr double kTumDepthScale = 1.0 / 5000;

/// Images with their times (s), one each.
struct ImageList {
  std::vector<std::filesystem::path> images;
  std::vector<double> times;
};

/// Reads the `timestamp file` lines of TUM RGB-D (# begins a comment), at least one; the files must
/// lie below the folder of the list. Errors: not_found, io_failure, bad_file with file and line.
Result<ImageList> read_image_list(const std::filesystem::path& path);

/// Finds the images as open_frames describes. Errors: not_found, bad_file, invalid_argument.
Result<FrameLayout> find_frames(const std::vector<std::filesystem::path>& inputs);

/// The first of `names` that exists in one of the layout's folders.
std::optional<std::filesystem::path> find_beside(const FrameLayout& layout,
                                                 std::initializer_list<std::string_view> names);

/// The first of pose.txt, poses.txt, trajectory.log, trajectory.txt and groundtruth.txt that exists
/// in one of `folders`.
std::optional<std::filesystem::path> find_pose_list(
    const std::vector<std::filesystem::path>& folders);

/// Whether the ending is one of a depth image: PNG, PGM or TIFF, in any case.
bool is_depth_image(const std::filesystem::path& path);

/// Whether `a` comes before `b` when runs of digits are compared as numbers.
bool natural_less(std::string_view a, std::string_view b);

}  // namespace burnish
