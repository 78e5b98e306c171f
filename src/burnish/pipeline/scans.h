#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/core/point_cloud.h"
#include "burnish/pipeline/recipe.h"
#include "burnish/pipeline/record.h"
#include "burnish/pipeline/registered_frames.h"
#include "burnish/sensor/frame_sequence.h"

namespace burnish {

/// What was scanned and how to read it. `frames` tells of poses, camera, sensor and depth scale;
/// clouds use its poses, and organized ones without sigma its sensor's noise (kinect_v1's where it
/// names none).
struct ScanInputs {
  std::vector<std::filesystem::path>
      paths;  ///< folders of frames or of PCD, single frames, or clouds
  FrameOptions frames;
  FrameRegistration registration{};  ///< of several frames without poses
};

/// Points in world coordinates, with normals, and how they came about.
struct Scan {
  PointCloud cloud;
  std::vector<std::string> notes;  ///< what their reader left out or changed
  std::vector<Step> steps;         ///< what was done to the frames that they are from
  std::optional<PointCloud> raw;   ///< positions as measured, where these steps may have moved them
  std::optional<DepthFrame>
      frame;  ///< whose pixels the points are, after the steps, where it is one
};

/// One or more scans.
class Scans {
 public:
  virtual ~Scans() = default;
  virtual std::size_t size() const = 0;

  /// Errors: those of reading the file, and bad_geometry where it holds no point.
  virtual Result<Scan> read(std::size_t i, const Context& context) const = 0;

  /// Where the first camera stood, provided that it was one: that scan 0 is organized.
  virtual Viewpoint viewpoint() const = 0;

  const std::vector<std::string>& notes() const { return notes_; }
  /// What it took to open them.
  const std::vector<Step>& steps() const { return steps_; }

 protected:
  std::vector<std::string> notes_;
  std::vector<Step> steps_;
};

/// Recognises what `inputs` are. A folder of PCD is read in natural order (9 before 10), and with
/// the list of poses that lies in it where none is given, as folders of frames are. Errors:
/// not_found; bad_file; invalid_argument where frames and clouds are mixed, where there are several
/// clouds and no poses, or as many as there are not, and where steps for frames meet clouds.
///
/// Several frames without poses are registered (register_frames); those that fit nowhere are left
/// out, with a note.
///
/// With steps.average a scan is the mean of up to frames_at_once frames that follow each other and
/// have the same pose to the bit. Frames without poses are then from one place, with a note: a
/// camera that stands still is what they are averaged for. No more frames than these are held at a
/// time. `keep_raw`: scans of frames on which steps have worked bring their raw points, too.
Result<std::unique_ptr<Scans>> open_scans(const ScanInputs& inputs, const FrameSteps& steps = {},
                                          bool keep_raw = false, const Context& context = {});

}  // namespace burnish
