#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "burnish/base/result.h"
#include "burnish/sensor/camera_file.h"
#include "burnish/sensor/recorded_frame.h"
#include "burnish/sensor/recording.h"

namespace burnish {

/// What a recording says of all its frames.
struct RecordingInfo {
  CameraFile camera;  ///< as far as it is known; a depth scale is always there
  std::optional<bool>
      registered;  ///< whether colour and depth pixels of one place are of one point
  std::vector<std::pair<std::string, std::string>> said;  ///< what else is worth keeping
  std::vector<std::string> notes;  ///< what was assumed or left out, one sentence each
};

/// An open recording.
class Recording {
 public:
  virtual ~Recording() = default;

  const RecordingInfo& info() const { return info_; }
  virtual std::size_t size() const = 0;  ///< frames, at least one

  /// Frame `i` < size(); called with rising `i`. Errors name the file and the place.
  virtual Result<RecordedFrame> read(std::size_t i) = 0;

 protected:
  RecordingInfo info_;
};

/// What a recording is told by.
struct RecordingPlace {
  std::filesystem::path path;
  bool is_folder = false;
  std::string_view bytes;  ///< of the file, mapped; of a folder none
};

/// One row of the table of formats.
struct RecordingFormat {
  std::string_view name, title;
  bool (*recognises)(const RecordingPlace& place);  ///< by content
  Result<std::unique_ptr<Recording>> (*open)(const std::filesystem::path& path,
                                             const ImportParams& params);
};

RecordingFormat oni_format();
RecordingFormat azure_format();
RecordingFormat fakenect_format();
RecordingFormat pclzf_format();
RecordingFormat klg_format();
RecordingFormat tum_format();
RecordingFormat images_format();

/// All of them, in the order in which they are asked whether a recording is theirs.
const std::vector<RecordingFormat>& recording_formats();

}  // namespace burnish
