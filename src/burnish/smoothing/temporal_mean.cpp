#include "burnish/smoothing/temporal_mean.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "burnish/base/parallel.h"

namespace burnish {
namespace {

/// A depth and what it adds to a mean.
struct Sample {
  float depth;
  std::uint32_t frame;
};

/// The mean of one pixel.
struct PixelMean {
  double depth = 0;  ///< 0: none
  double noise_share = 0, sigma_share = 0;
  std::uint32_t observations = 0;
  std::uint32_t measured = 0, counted = 0;  ///< frames with a depth, and those that agree
};

/// What is left of a variance of which `repeated` is the same in all samples: `mean` is the
/// weighted mean of their variances, `squares` the sum of the squared weights times them.
double share_left(double repeated, double mean, double squares) {
  return std::sqrt(repeated * mean + (1 - repeated) * squares);
}

/// Averages pixel by pixel; a thread has its own.
class PixelAverage {
 public:
  PixelAverage(const std::vector<const DepthFrame*>& frames, const TemporalMeanParams& params)
      : frames_(frames), params_(params) {
    samples_.reserve(frames.size());
  }

  PixelMean of(std::size_t pixel) {
    samples_.clear();
    for (std::uint32_t f = 0; f < frames_.size(); ++f) {
      const float depth = frames_[f]->depth[pixel];
      if (depth > 0) samples_.push_back({depth, f});
    }
    PixelMean mean;
    mean.measured = static_cast<std::uint32_t>(samples_.size());
    if (samples_.empty()) return mean;
    const double sigma = keep_agreeing(pixel);
    mean.counted = static_cast<std::uint32_t>(samples_.size());
    const double least = params_.least_share * static_cast<double>(frames_.size());
    if (mean.counted > 0 && static_cast<double>(mean.counted) >= least) average(pixel, sigma, mean);
    return mean;
  }

 private:
  /// Drops the samples that are too far from the median; the others stay in the order of the
  /// frames. Returns the sensor's deviation there. Outliers on one side have the median of all off
  /// to that side: the one of those that agree with it says better which ones do.
  double keep_agreeing(std::size_t pixel) {
    all_ = samples_;
    double sigma = 0;
    for (int round = 0; round < 2 && !samples_.empty(); ++round) {
      const double median = median_of(samples_);
      sigma = frames_.front()->noise.axial(median, 0);
      samples_.clear();
      std::copy_if(all_.begin(), all_.end(), std::back_inserter(samples_), [&](const Sample& s) {
        const double share = frames_[s.frame]->noise_share_of(pixel);
        return std::abs(s.depth - median) <= params_.outlier * share * sigma;
      });
    }
    return sigma;
  }

  /// Of two in the middle their mean. `samples` must not be empty.
  double median_of(const std::vector<Sample>& samples) {
    sorted_.clear();
    for (const Sample& sample : samples) sorted_.push_back(sample.depth);
    const auto middle = sorted_.begin() + static_cast<std::ptrdiff_t>(sorted_.size() / 2);
    std::nth_element(sorted_.begin(), middle, sorted_.end());
    if (sorted_.size() % 2 == 1) return *middle;
    return (double{*middle} + *std::max_element(sorted_.begin(), middle)) / 2;
  }

  void average(std::size_t pixel, double deviation, PixelMean& mean) const {
    double total = 0, depth = 0;
    double noise = 0, noise_squares = 0, sigma = 0, sigma_squares = 0;
    for (const Sample& sample : samples_) {
      const DepthFrame& frame = *frames_[sample.frame];
      const double s = deviation * frame.noise_share_of(pixel);
      const double weight = s > 0 ? 1 / (s * s) : 1;
      const double n = frame.noise_share_of(pixel), now = frame.sigma_share_of(pixel);
      total += weight;
      depth += weight * sample.depth;
      noise += weight * n * n;
      noise_squares += weight * weight * n * n;
      sigma += weight * now * now;
      sigma_squares += weight * weight * now * now;
      mean.observations += frame.observations.empty() ? 1 : frame.observations[pixel];
    }
    mean.depth = depth / total;
    const double squared = total * total;
    mean.noise_share = share_left(params_.repeated, noise / total, noise_squares / squared);
    mean.sigma_share = share_left(params_.repeated, sigma / total, sigma_squares / squared);
  }

  const std::vector<const DepthFrame*>& frames_;
  const TemporalMeanParams& params_;
  std::vector<Sample> samples_, all_;
  std::vector<float> sorted_;
};

struct Counts {
  std::size_t pixels = 0, dropped = 0, outliers = 0, counted = 0;

  void add(const PixelMean& mean) {
    const bool kept = mean.depth > 0;
    pixels += kept;
    dropped += mean.measured > 0 && !kept;
    outliers += mean.measured - mean.counted;
    counted += kept ? mean.counted : 0;
  }
  void add(const Counts& other) {
    pixels += other.pixels, dropped += other.dropped;
    outliers += other.outliers, counted += other.counted;
  }
};

Result<TemporalMean> mean_of(const std::vector<const DepthFrame*>& frames,
                             const TemporalMeanParams& params, const Context& context) {
  if (auto valid = TemporalMeanParams::schema().check(params); !valid) return valid.error();
  if (frames.empty()) {
    return Error{ErrorCode::invalid_argument, "no frame to take the mean of", {}};
  }
  const DepthFrame& first = *frames.front();
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const std::string where = fmt::format("frame {} of {}", f + 1, frames.size());
    if (auto sound = check(*frames[f]); !sound) {
      return Error{sound.error().code, sound.error().message, where};
    }
    if (!from_one_place(first, *frames[f])) {
      return Error{ErrorCode::bad_geometry,
                   "it is not of the first frame's camera and place: their pixels see other things",
                   where};
    }
  }
  const auto any_sigma = std::any_of(frames.begin(), frames.end(), [](const DepthFrame* frame) {
    return !frame->sigma_share.empty();
  });
  const std::size_t count = first.depth.size();
  TemporalMean result;
  DepthFrame& mean = result.frame;
  mean.camera = first.camera;
  mean.T_world_camera = first.T_world_camera;
  mean.noise = first.noise;
  mean.time = frames.back()->time;
  mean.depth.resize(count);
  mean.noise_share.resize(count);
  if (any_sigma) mean.sigma_share.resize(count);
  mean.observations.resize(count);
  Counts counts;
  const bool complete = parallel_reduce(
      context, count, counts,
      [&](IndexRange range) {
        PixelAverage average(frames, params);
        Counts part;
        for (std::size_t i = range.begin; i < range.end; ++i) {
          const PixelMean pixel = average.of(i);
          part.add(pixel);
          mean.depth[i] = static_cast<float>(pixel.depth);
          mean.noise_share[i] = static_cast<float>(pixel.noise_share);
          if (any_sigma) mean.sigma_share[i] = static_cast<float>(pixel.sigma_share);
          mean.observations[i] = pixel.observations;
        }
        return part;
      },
      [](Counts& total, const Counts& part) { total.add(part); });
  if (!complete) return cancelled();
  const double pixels = static_cast<double>(std::max<std::size_t>(counts.pixels, 1));
  result.report = {frames.size(), counts.pixels, counts.dropped, counts.outliers,
                   static_cast<double>(counts.counted) / pixels};
  context.progress(1);
  return result;
}

}  // namespace

const Schema<TemporalMeanParams>& TemporalMeanParams::schema() {
  using P = TemporalMeanParams;
  static const auto schema =
      Schema<P>()
          .real("outlier", &P::outlier, more_than(0),
                "depths farther from the median, in standard deviations, do not count")
          .real("least_share", &P::least_share, between(0, 1),
                "share of the frames that must agree for a pixel to have a depth")
          .real("repeated", &P::repeated, between(0, 1),
                "share of the noise's variance that is the same in every frame");
  return schema;
}

Facts TemporalMeanReport::facts() const {
  return {{"frames", static_cast<double>(frames), ""},
          {"pixels", static_cast<double>(pixels), ""},
          {"dropped_pixels", static_cast<double>(dropped_pixels), ""},
          {"outliers", static_cast<double>(outliers), ""},
          {"mean_count", mean_count, ""}};
}

bool from_one_place(const DepthFrame& a, const DepthFrame& b) {
  return a.camera == b.camera && a.noise == b.noise && a.T_world_camera == b.T_world_camera;
}

Result<TemporalMean> temporal_mean(std::span<const DepthFrame> frames,
                                   const TemporalMeanParams& params, const Context& context) {
  std::vector<const DepthFrame*> all;
  for (const DepthFrame& frame : frames) all.push_back(&frame);
  return mean_of(all, params, context);
}

void TemporalWindow::add(DepthFrame frame) {
  if (!frames_.empty() && !from_one_place(frames_.back(), frame)) frames_.clear();
  frames_.push_back(std::move(frame));
  if (frames_.size() > window_) frames_.pop_front();
}

Result<TemporalMean> TemporalWindow::mean(const TemporalMeanParams& params,
                                          const Context& context) const {
  std::vector<const DepthFrame*> all;
  for (const DepthFrame& frame : frames_) all.push_back(&frame);
  return mean_of(all, params, context);
}

}  // namespace burnish
