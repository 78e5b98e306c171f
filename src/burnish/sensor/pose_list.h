#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "burnish/base/result.h"
#include "burnish/base/rigid.h"

namespace burnish {

/// Camera poses (camera to world) in the order of a file.
struct PoseList {
  std::vector<RigidTransform> poses;
  std::vector<bool> unknown{};  ///< empty, or per pose whether the file says that nobody knows it
  std::vector<double> times;    ///< s; empty, or one per pose
  std::string format;  ///< "position and quaternion", "TUM trajectory" or "Redwood trajectory"
};

/// Reads a pose list; which of three formats it is in, the number of words on its first line says:
///   7   `x y z qx qy qz qw`
///   8   `timestamp x y z qx qy qz qw` (TUM RGB-D)
///   3   `i j k`, then four rows of a 4x4 matrix, and so on (Redwood trajectory.log)
/// In a list of 7 words a line `-` says that a pose is not known. Metres; # begins a comment. A
/// quaternion must have length 1 within 1 %, a matrix must be a rotation and a translation within
/// 1e-3; matrices are taken as they are, quaternions normalised. Errors: not_found, io_failure,
/// bad_file with file and line.
Result<PoseList> read_pose_list(const std::filesystem::path& path);

/// The text of a list of 7 words: a line for every pose, `-` with the words of `comments` behind #
/// for one that is not known.
std::string pose_list_text(std::span<const std::optional<RigidTransform>> poses,
                           std::span<const std::string> comments = {});

/// Reads one 4x4 camera-to-world matrix, row by row (7-Scenes). Errors as above.
Result<RigidTransform> read_pose_matrix(const std::filesystem::path& path);

/// The text of a 4x4 matrix; reading it back gives the same numbers.
std::string pose_matrix_text(const RigidTransform& pose);

}  // namespace burnish
