#include "burnish/pipeline/scans.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "burnish/base/parallel.h"
#include "burnish/core/transform.h"
#include "burnish/io/geometry_file.h"
#include "burnish/pipeline/phases.h"
#include "burnish/points/estimate_normals.h"
#include "burnish/points/sensor_noise.h"
#include "burnish/points/unproject.h"
#include "burnish/sensor/frame_layout.h"
#include "burnish/sensor/pose_list.h"
#include "burnish/sensor/presets.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

Error no_poses(std::size_t count) {
  return {ErrorCode::invalid_argument,
          fmt::format(
              "{} clouds and no poses: give --poses FILE, a line `x y z qx qy qz qw` (camera to "
              "world) for each of them, or a Redwood trajectory.log or TUM trajectory",
              count),
          {}};
}

/// Depth images, seen through their camera.
class FrameScans : public Scans {
 public:
  FrameScans(FrameSequence frames, FrameSteps steps, bool keep_raw, Record opening)
      : frames_(std::move(frames)), frame_steps_(std::move(steps)), keep_raw_(keep_raw) {
    notes_ = frames_.notes();
    notes_.insert(notes_.end(), opening.notes.begin(), opening.notes.end());
    steps_ = std::move(opening.steps);
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      if (i == 0 || !belongs_to_last(i)) groups_.push_back({i, i});
      ++groups_.back().end;
    }
    if (!frame_steps_.average || frames_.size() == 1) return;
    if (!frames_.has_poses()) {
      notes_.push_back(fmt::format("{} frames without poses are averaged as seen from one place",
                                   frames_.size()));
    } else if (groups_.size() == frames_.size()) {
      notes_.push_back("no two frames that follow each other have the same pose: none is averaged");
    }
  }

  std::size_t size() const override { return groups_.size(); }

  Result<Scan> read(std::size_t i, const Context& context) const override {
    Scan scan;
    Result<DepthFrame> frame = read_frame(groups_[i], scan, context.part(0, 0.5));
    if (!frame) return std::move(frame).error();
    Record record;
    if (auto filtered = filter_frame(*frame, frame_steps_.filter, record, context.part(0.5, 0.7));
        !filtered) {
      return filtered.error();
    }
    std::move(record.steps.begin(), record.steps.end(), std::back_inserter(scan.steps));
    Result<PointCloud> cloud = unproject(*frame, {}, context.part(0.7, 1));
    if (!cloud) return std::move(cloud).error();
    scan.cloud = *std::move(cloud);
    scan.frame = *std::move(frame);
    return scan;
  }

  Viewpoint viewpoint() const override {
    return Viewpoint{frames_.camera(),
                     frames_.files().front().T_world_camera.value_or(RigidTransform{})};
  }

 private:
  /// Whether frame `i` is averaged with the group that ends before it.
  bool belongs_to_last(std::size_t i) const {
    const std::vector<FrameFile>& files = frames_.files();
    const IndexRange& group = groups_.back();
    return frame_steps_.average &&
           group.end - group.begin < std::size_t(frame_steps_.frames_at_once) &&
           files[i].T_world_camera == files[i - 1].T_world_camera;
  }

  /// One frame, or the mean of several. Adds raw points and steps to `scan`.
  Result<DepthFrame> read_frame(const IndexRange& group, Scan& scan, const Context& context) const {
    std::vector<DepthFrame> frames;
    for (std::size_t i = group.begin; i < group.end; ++i) {
      if (context.cancelled()) return cancelled();
      Result<DepthFrame> frame = frames_.read(i);
      if (!frame) return frame;
      frames.push_back(*std::move(frame));
    }
    if (keep_raw_ && (frame_steps_.average || !frame_steps_.filter.empty())) {
      if (auto kept = keep_raw(frames, scan); !kept) return kept.error();
    }
    if (!frame_steps_.average) return std::move(frames.front());
    Record record;
    auto mean = average_frames(frames, *frame_steps_.average, record, context);
    scan.steps = std::move(record.steps);
    return mean;
  }

  static Result<void> keep_raw(const std::vector<DepthFrame>& frames, Scan& scan) {
    for (const DepthFrame& frame : frames) {
      Result<PointCloud> points = unproject(frame, {.normals = false}, {});
      if (!points) return std::move(points).error();
      if (!scan.raw) scan.raw = PointCloud{{}, {}, {}, {}, points->frame};
      for (const Vec3f& p : points->positions) {
        if (is_finite(p)) scan.raw->positions.push_back(p);
      }
    }
    return {};
  }

  FrameSequence frames_;
  FrameSteps frame_steps_;
  bool keep_raw_;
  std::vector<IndexRange> groups_;  ///< the frames of each scan
};

/// Gives the points of an organized cloud the noise of the sensor, as unproject does for frames.
/// The camera looks along +z from the viewpoint.
void add_noise(PointCloud& cloud, const Sensor& sensor) {
  const Vec3d eye = cloud.viewpoint.value_or(Vec3d{}) - cloud.frame.origin;
  cloud.attributes.sigma.assign(cloud.positions.size(), 0);
  cloud.attributes.noise.assign(cloud.positions.size(), {});
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    if (!is_finite(cloud.positions[i])) continue;
    const Vec3d ray = Vec3d(cloud.positions[i]) - eye;
    const MeasuredNoise measured =
        measured_noise(sensor.noise, sensor.camera.fx, ray.z, ray, cloud.attributes.normals[i]);
    cloud.attributes.sigma[i] = measured.sigma;
    cloud.attributes.noise[i] = measured.noise;
  }
}

/// Files of points.
class CloudScans : public Scans {
 public:
  CloudScans(std::vector<fs::path> files, std::vector<RigidTransform> poses, Sensor sensor)
      : files_(std::move(files)), poses_(std::move(poses)), sensor_(std::move(sensor)) {}

  std::size_t size() const override { return files_.size(); }

  Result<Scan> read(std::size_t i, const Context& context) const override {
    Result<GeometryFile> file = read_geometry(files_[i], context.part(0, 0.5));
    if (!file) return std::move(file).error();
    Scan scan;
    for (const std::string& note : file->notes)
      scan.notes.push_back(fmt::format("{}: {}", files_[i].string(), note));
    PointCloud& cloud = scan.cloud = cloud_of(*std::move(file));
    const auto measured = [](const Vec3f& p) { return is_finite(p); };
    if (std::none_of(cloud.positions.begin(), cloud.positions.end(), measured)) {
      return Error{ErrorCode::bad_geometry, "holds no point", files_[i].string()};
    }
    Attributes& attributes = cloud.attributes;
    if (attributes.normals.empty()) {
      if (auto estimated = estimate_normals(cloud, {}, context.part(0.5, 1)); !estimated)
        return estimated.error();
    }
    if (cloud.grid && attributes.sigma.empty()) add_noise(cloud, sensor_);
    if (attributes.observations.empty()) attributes.observations.assign(cloud.positions.size(), 1);
    if (attributes.origin.empty()) attributes.origin.assign(cloud.positions.size(), Origin::seen);
    if (!poses_.empty()) cloud = transformed(std::move(cloud), poses_[i]);
    return scan;
  }

  /// Depth cameras write organized clouds in their own coordinates, z forward.
  Viewpoint viewpoint() const override {
    return {sensor_.camera, poses_.empty() ? RigidTransform{} : poses_.front()};
  }

 private:
  std::vector<fs::path> files_;
  std::vector<RigidTransform> poses_;  ///< empty, or one per file
  Sensor sensor_;
};

Result<std::unique_ptr<Scans>> open_clouds(const ScanInputs& inputs, const FrameSteps& steps) {
  if (steps.average || !steps.filter.empty()) {
    return Error{ErrorCode::invalid_argument,
                 "averages and filters are of depth frames, these are clouds",
                 inputs.paths.front().string()};
  }
  if (inputs.frames.camera || inputs.frames.depth_scale) {
    return Error{ErrorCode::invalid_argument,
                 "a camera and a depth scale belong to depth frames, not to clouds",
                 inputs.paths.front().string()};
  }
  const Result<Sensor> sensor =
      find_sensor(inputs.frames.sensor.empty() ? "kinect_v1" : inputs.frames.sensor);
  if (!sensor) return sensor.error();
  std::vector<RigidTransform> poses;
  if (!inputs.frames.poses.empty()) {
    Result<PoseList> list = read_pose_list(inputs.frames.poses);
    if (!list) return std::move(list).error();
    if (const auto unknown = std::find(list->unknown.begin(), list->unknown.end(), true);
        unknown != list->unknown.end()) {
      return Error{ErrorCode::invalid_argument,
                   fmt::format("cloud {} has no pose there: leave it out of the input",
                               unknown - list->unknown.begin()),
                   inputs.frames.poses.string()};
    }
    poses = std::move(list->poses);
    if (poses.size() != inputs.paths.size()) {
      return Error{ErrorCode::invalid_argument,
                   fmt::format("{} poses for {} clouds", poses.size(), inputs.paths.size()),
                   inputs.frames.poses.string()};
    }
  } else if (inputs.paths.size() > 1) {
    return no_poses(inputs.paths.size());
  }
  return std::unique_ptr<Scans>(
      std::make_unique<CloudScans>(inputs.paths, std::move(poses), *sensor));
}

Result<std::unique_ptr<Scans>> open_images(const ScanInputs& inputs, const FrameSteps& steps,
                                           bool keep_raw, const Context& context) {
  Result<FrameSequence> frames = open_frames(inputs.paths, inputs.frames);
  if (!frames) return std::move(frames).error();
  Record opening;
  if (frames->size() > 1 && !frames->has_poses() && !steps.average) {
    const auto found = register_frames(*frames, inputs.registration, opening, context);
    if (!found) return found.error();
    *frames = frames->with_poses(found->poses.T_world_view);
  }
  return std::unique_ptr<Scans>(
      std::make_unique<FrameScans>(*std::move(frames), steps, keep_raw, std::move(opening)));
}

bool is_folder(const fs::path& path) {
  std::error_code unreadable;
  return fs::is_directory(path, unreadable);
}

std::string lower_ending(const fs::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return ending;
}

/// The organized clouds of a folder in natural order; none where it holds depth images or no
/// clouds.
std::vector<fs::path> clouds_in(const fs::path& folder) {
  std::vector<fs::path> clouds;
  std::error_code unreadable;
  for (const auto& entry : fs::directory_iterator(folder, unreadable)) {
    if (is_depth_image(entry.path())) return {};
    if (lower_ending(entry.path()) == ".pcd") clouds.push_back(entry.path());
  }
  std::sort(clouds.begin(), clouds.end(), [](const fs::path& a, const fs::path& b) {
    return natural_less(a.filename().string(), b.filename().string());
  });
  return clouds;
}

/// Folders of clouds replaced by what they hold.
std::vector<fs::path> unfolded(const std::vector<fs::path>& paths) {
  std::vector<fs::path> result;
  for (const fs::path& path : paths) {
    const std::vector<fs::path> clouds =
        is_folder(path) ? clouds_in(path) : std::vector<fs::path>{};
    if (clouds.empty()) {
      result.push_back(path);
    } else {
      result.insert(result.end(), clouds.begin(), clouds.end());
    }
  }
  return result;
}

bool is_image_or_folder(const fs::path& path) {
  return is_folder(path) || is_depth_image(path);
}

}  // namespace

Result<std::unique_ptr<Scans>> open_scans(const ScanInputs& given, const FrameSteps& steps,
                                          bool keep_raw, const Context& context) {
  if (given.paths.empty())
    return Error{ErrorCode::invalid_argument, "nothing to reconstruct from", {}};
  for (const fs::path& path : given.paths) {
    std::error_code unreadable;
    if (!fs::exists(path, unreadable))
      return Error{ErrorCode::not_found, "no such file or folder", path.string()};
  }
  ScanInputs inputs = given;
  inputs.paths = unfolded(given.paths);
  const bool images = is_image_or_folder(inputs.paths.front());
  const bool one_folder = given.paths.size() == 1 && is_folder(given.paths.front());
  if (!images && one_folder && inputs.frames.poses.empty())
    inputs.frames.poses = find_pose_list(given.paths).value_or("");
  for (const fs::path& path : inputs.paths) {
    if (is_image_or_folder(path) != images) {
      return Error{ErrorCode::invalid_argument, "depth frames and clouds cannot be mixed",
                   path.string()};
    }
  }
  return images ? open_images(inputs, steps, keep_raw, context) : open_clouds(inputs, steps);
}

}  // namespace burnish
