#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/facts.h"
#include "burnish/base/schema.h"
#include "burnish/sensor/camera_file.h"
#include "burnish/sensor/frame_poses.h"

namespace burnish {

struct ImportParams {
  int every = 1;                     ///< of so many frames one is taken
  int frames = 0;                    ///< at most so many are taken; 0: all
  bool poses = true;                 ///< whether poses are taken over
  double time_window = kTimeWindow;  ///< s, between a depth image and its colour image or pose

  static const Schema<ImportParams>& schema();
};

/// What an import did.
struct ImportReport {
  std::string format;  ///< the title of the format
  std::size_t frames = 0, color_images = 0, posed_frames = 0;
  double measured_share = 0;       ///< of the pixels: those with a depth
  std::vector<std::string> notes;  ///< what was assumed or left out, one sentence each

  Facts facts() const;
};

/// What import_recording reads: docs/recordings.md says what each holds.
struct RecordingTitle {
  std::string_view name;   ///< "klg"
  std::string_view title;  ///< "KLG, log of Kintinuous and ElasticFusion"
};
std::vector<RecordingTitle> recording_titles();

/// Writes the frames of a recording, told by its content, to `folder` (frame_folder.h says what).
/// Depths keep their numbers and their unit, colour images their bytes where they are PNG or JPEG.
/// `given` goes before what the recording says of its camera; a camera of no size is for frames of
/// any. Where frames have poses and `params.poses` is set, frames without one are left out, with a
/// note. Holds one frame at a time.
///
/// On error or cancellation the folder is as before. Errors: not_found; unsupported where the
/// recording is of no known kind; bad_file with file and place for one that is damaged, whose
/// counts are wrong or whose frames have different sizes; invalid_argument, io_failure, cancelled.
Result<ImportReport> import_recording(const std::filesystem::path& recording,
                                      const std::filesystem::path& folder,
                                      const ImportParams& params = {}, const CameraFile& given = {},
                                      const Context& context = {});

}  // namespace burnish
