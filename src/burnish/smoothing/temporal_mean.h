#pragma once

#include <deque>
#include <span>

#include "burnish/base/context.h"
#include "burnish/base/facts.h"
#include "burnish/base/schema.h"
#include "burnish/core/depth_frame.h"

namespace burnish {

struct TemporalMeanParams {
  double outlier = 3;  ///< standard deviations from the median beyond which a depth does not count
  double least_share = 0.5;  ///< of the frames that must agree for a pixel to have a depth
  double repeated = 0.25;    ///< share of the noise's variance that is the same in every frame

  static const Schema<TemporalMeanParams>& schema();
};

/// What a mean of frames did.
struct TemporalMeanReport {
  std::size_t frames = 0;
  std::size_t pixels = 0;          ///< that have a depth now
  std::size_t dropped_pixels = 0;  ///< that had one in some frames, too few
  std::size_t outliers = 0;        ///< depths, of all frames, that did not count
  double mean_count = 0;           ///< of depths in a pixel's mean

  Facts facts() const;
};

/// A frame, and how it came about.
struct TemporalMean {
  DepthFrame frame;
  TemporalMeanReport report;
};

/// Whether two frames are of one camera, with one noise, from one place: whether they may be
/// averaged. Poses are compared to the bit.
bool from_one_place(const DepthFrame& a, const DepthFrame& b);

/// Pixel by pixel the mean of frames that a camera took from one place, weighted by 1 / variance.
///
/// Frames in which a pixel has no depth do not count for it. Nor do depths that are more than
/// `outlier` standard deviations from the median; this is
/// done twice, the second time with the median of those that agreed the first time. So what moves
/// through the picture leaves no trace where the rest is seen most of the time. Where fewer than
/// `least_share` of the frames agree, the pixel has no depth: outlines flicker between two
/// surfaces. Deviation and weight are the noise model's at the depth of the median (at a depth's
/// own, near ones would weigh more), times the depth's noise_share.
///
/// noise_share: of n depths that count the mean's variance is repeated + (1 - repeated) / n of
/// one's. What a camera does alike in every frame (lens, calibration, the pattern of its pixels,
/// steps of disparity where the noise is less than a step) no mean takes out, however many frames;
/// it was within the deviation that the model's authors measured, but they do not say how much it
/// was. The quarter, with which sigma stays above half of a single frame's, is this project's
/// choice. sigma_share likewise, where the frames have it; observations add up; time is the last
/// frame's.
///
/// O(frames * #pixels). Errors: invalid_argument (no frame), bad_geometry (a
/// frame that is not sound, or not of the first one's camera, noise and place), cancelled.
Result<TemporalMean> temporal_mean(std::span<const DepthFrame> frames,
                                   const TemporalMeanParams& params = {},
                                   const Context& context = {});

/// The same for a camera that runs: the mean of the last frames. Holds `window` frames, no more.
class TemporalWindow {
 public:
  /// window: at least 1.
  explicit TemporalWindow(std::size_t window) : window_(window) {}

  /// Takes a frame in and lets go of the oldest where there are too many. A frame from another
  /// place begins anew: all older ones go.
  void add(DepthFrame frame);
  std::size_t size() const { return frames_.size(); }

  /// The temporal_mean of the frames that are held.
  Result<TemporalMean> mean(const TemporalMeanParams& params = {},
                            const Context& context = {}) const;

 private:
  std::size_t window_;
  std::deque<DepthFrame> frames_;
};

}  // namespace burnish
