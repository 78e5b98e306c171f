#include "burnish/sensor/frame_poses.h"

#include <fmt/format.h>

#include "burnish/sensor/nearest_time.h"
#include "burnish/sensor/pose_list.h"

namespace burnish {
namespace fs = std::filesystem;
namespace {

/// NAME.pose.txt for NAME.depth.png; empty for other names.
fs::path pose_file_of(const fs::path& image) {
  const fs::path name = image.stem();
  if (name.extension() != ".depth") return {};
  return image.parent_path() / (name.stem().string() + ".pose.txt");
}

/// Gives every file the pose beside it; false where not even the first has one.
Result<bool> read_poses_beside(std::vector<FrameFile>& files) {
  std::error_code ignored;
  const fs::path first = pose_file_of(files.front().image);
  if (first.empty() || !fs::exists(first, ignored)) return false;
  for (FrameFile& file : files) {
    const fs::path path = pose_file_of(file.image);
    if (path.empty()) {
      return Error{ErrorCode::invalid_argument,
                   "the first image has a pose file beside it, this one is not called NAME.depth.*",
                   file.image.string()};
    }
    const auto pose = read_pose_matrix(path);
    if (!pose) return pose.error();
    file.T_world_camera = *pose;
  }
  return true;
}

/// Images whose pose nobody knows are dropped.
Result<void> assign_in_order(const PoseList& list, const fs::path& path,
                             std::vector<FrameFile>& files, std::vector<std::string>& notes) {
  if (list.poses.size() != files.size()) {
    return Error{ErrorCode::invalid_argument,
                 fmt::format("{} poses for {} depth images, as many as images are expected",
                             list.poses.size(), files.size()),
                 path.string()};
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    files[i].T_world_camera = list.poses[i];
    if (!list.times.empty()) files[i].time = list.times[i];
    if (!list.unknown.empty() && list.unknown[i]) files[i].T_world_camera.reset();
  }
  const std::size_t all = files.size();
  std::erase_if(files, [](const FrameFile& file) { return !file.T_world_camera; });
  if (files.size() < all) {
    notes.push_back(fmt::format("{} of {} depth images are left out: {} does not know their poses",
                                all - files.size(), all, path.filename().string()));
  }
  return {};
}

/// Gives every image the pose nearest in time, and drops images that have none near enough.
Result<void> assign_by_time(const PoseList& list, const fs::path& path, double window,
                            std::vector<FrameFile>& files, std::vector<std::string>& notes) {
  const NearestTime times(list.times);
  for (FrameFile& file : files) {
    if (const auto pose = times.find(file.time, window)) file.T_world_camera = list.poses[*pose];
  }
  const std::size_t all = files.size();
  std::erase_if(files, [](const FrameFile& file) { return !file.T_world_camera; });
  if (files.empty()) {
    return Error{ErrorCode::bad_file,
                 fmt::format("none of its {} poses is within {} s of one of the {} depth images",
                             list.poses.size(), window, all),
                 path.string()};
  }
  if (files.size() < all) {
    notes.push_back(fmt::format("{} of {} depth images have no pose within {} s and are left out",
                                all - files.size(), all, window));
  }
  return {};
}

}  // namespace

std::vector<FrameFile> files_of(const FrameLayout& layout) {
  std::vector<FrameFile> files;
  for (std::size_t i = 0; i < layout.images.size(); ++i) {
    files.push_back({layout.images[i], std::nullopt, layout.times.empty() ? 0 : layout.times[i]});
  }
  return files;
}

Result<bool> find_poses(const FrameLayout& layout, const fs::path& given, double window,
                        std::vector<FrameFile>& files, std::vector<std::string>& notes) {
  fs::path path = given;
  if (path.empty()) {
    const auto beside = read_poses_beside(files);
    if (!beside || *beside) return beside;
    if (!layout.whole_folder) return false;
    path = find_pose_list(layout.folders).value_or("");
    if (path.empty()) return false;
  }
  const auto list = read_pose_list(path);
  if (!list) return list.error();
  const bool timed = !list->times.empty() && !layout.times.empty();
  const auto assigned = timed ? assign_by_time(*list, path, window, files, notes)
                              : assign_in_order(*list, path, files, notes);
  if (!assigned) return assigned.error();
  return true;
}

}  // namespace burnish
