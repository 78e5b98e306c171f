#pragma once

#include "burnish/sensor/frame_poses.h"
#include "burnish/sensor/recording_format.h"

namespace burnish {

/// A colour image on disk, and when it was taken.
struct ColorFile {
  std::filesystem::path image;  ///< empty: there is none
  std::optional<double> time{};
};

/// Reads it; nothing where there is none. Errors: those of read_color_image.
Result<ColorImage> read_color(const ColorFile& file);

/// A recording that is a folder of depth images.
class FolderRecording : public Recording {
 public:
  /// `colors`: one per file. Errors of the images come with read().
  FolderRecording(RecordingInfo info, std::vector<FrameFile> files, bool timed,
                  std::vector<ColorFile> colors)
      : files_(std::move(files)), colors_(std::move(colors)), timed_(timed) {
    info_ = std::move(info);
  }

  std::size_t size() const override { return files_.size(); }
  Result<RecordedFrame> read(std::size_t i) override;

 private:
  std::vector<FrameFile> files_;
  std::vector<ColorFile> colors_;
  bool timed_;
};

/// The images of a folder with their poses, as `params` want them, and what camera.txt or
/// camera-intrinsics.txt say.
struct PosedFolder {
  RecordingInfo info;  ///< without a depth scale where none is said
  FrameLayout layout;
  std::vector<FrameFile> files;
};
Result<PosedFolder> open_posed_folder(const std::filesystem::path& path,
                                      const ImportParams& params);

/// The colour image that is nearest in time to each depth image, within `window` (s); says in
/// `notes` how many have none.
std::vector<ColorFile> nearest_colors(const ImageList& colors, const std::vector<FrameFile>& files,
                                      double window, std::vector<std::string>& notes);

}  // namespace burnish
