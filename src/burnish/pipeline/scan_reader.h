#pragma once

#include <functional>

#include "burnish/core/frame_source.h"
#include "burnish/pipeline/recipe.h"
#include "burnish/pipeline/record.h"
#include "burnish/pipeline/scans.h"

namespace burnish {

/// The record's lines for all scans together: facts of the single ones added up, or what their
/// names say of them.
class SummedSteps {
 public:
  void add(const std::vector<Step>& steps);
  void move_to(std::vector<Step>& steps) &&;

 private:
  std::vector<Step> totals_;
  double scans_ = 0;
};

/// Reads scans, crops and cleans them as a recipe says, and keeps account of it.
class ScanReader {
 public:
  /// `see_raw` is shown the points of every scan as the sensor gave them, within the crop.
  ScanReader(const Scans& scans, const Recipe& recipe,
             std::function<void(const PointCloud&)> see_raw);

  std::size_t size() const { return scans_.size(); }

  /// Scan `i`, cropped and cleaned.
  Result<Scan> read(std::size_t i, const Context& context);

  /// The frame of scan `i` without the pixels that cropping and cleaning take out. With `counts` it
  /// is taken into account. Errors: also invalid_argument where the scan is no depth frame.
  Result<DepthFrame> read_frame(std::size_t i, const Context& context, bool counts);

  /// Moves what was read and done into the record. Errors: bad_geometry where no point was read.
  Result<void> finish(Record& record);

 private:
  const Scans& scans_;
  const Recipe& recipe_;
  std::function<void(const PointCloud&)> see_raw_;
  Step reading_{"read", "scans", {}, {}, 0, {}};
  SummedSteps on_frames_, cleaning_;
  std::vector<std::string> notes_;
  std::size_t points_ = 0;
};

/// Frames that a reader has read once: as many as fit into 256 MB (200 frames of 640 x 480) are
/// kept, the others are read again whenever they are asked for.
class ReadFrames : public FrameSource {
 public:
  /// Reads them all. `reader` must outlive this.
  static Result<ReadFrames> read_all(ScanReader& reader, const Context& context);

  std::size_t size() const override { return reader_->size(); }
  Result<DepthFrame> read(std::size_t i, const Context& context) const override;

 private:
  explicit ReadFrames(ScanReader& reader) : reader_(&reader) {}

  ScanReader* reader_;
  std::vector<DepthFrame> kept_;  ///< the first of them
};

}  // namespace burnish
