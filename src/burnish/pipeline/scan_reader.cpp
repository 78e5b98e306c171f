#include "burnish/pipeline/scan_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "burnish/pipeline/phases.h"

namespace burnish {
namespace {

constexpr std::size_t kKeptBytes = std::size_t{256} << 20;

std::size_t count_points(const PointCloud& cloud) {
  std::size_t count = 0;
  for (const Vec3f& p : cloud.positions) count += is_finite(p);
  return count;
}

/// Takes what is outside of `region` out of a cloud: missing pixels where it is organized.
void crop(PointCloud& cloud, const Region& region) {
  const auto inside = [&](const Vec3f& p) {
    return contains(region, cloud.frame.origin + Vec3d(p));
  };
  if (cloud.grid) {
    constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
    for (Vec3f& p : cloud.positions) {
      if (is_finite(p) && !inside(p)) p = {kMissing, kMissing, kMissing};
    }
    return;
  }
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < cloud.positions.size(); ++i) {
    if (inside(cloud.positions[i])) kept.push_back(i);
  }
  cloud = select(cloud, kept);
}

/// Adds what another scan says to a line.
void add(Step& total, const Step& step, double scans) {
  total.seconds += step.seconds;
  for (std::size_t i = 0; i < total.facts.size(); ++i) {
    double& sum = total.facts[i].value;
    const double value = step.facts[i].value;
    const std::string& key = total.facts[i].key;
    if (key.starts_with("max_")) {
      sum = std::max(sum, value);
    } else if (key.starts_with("mean_")) {
      sum = (scans * sum + value) / (scans + 1);
    } else if (key.starts_with("rms_")) {
      sum = std::sqrt((scans * sum * sum + value * value) / (scans + 1));
    } else {
      sum += value;
    }
  }
}

std::size_t bytes_of(const DepthFrame& frame) {
  return frame.depth.size() * sizeof(float) + frame.noise_share.size() * sizeof(float) +
         frame.sigma_share.size() * sizeof(float) +
         frame.observations.size() * sizeof(std::uint32_t);
}

}  // namespace

void SummedSteps::add(const std::vector<Step>& steps) {
  if (totals_.empty()) {
    totals_ = steps;
  } else {
    for (std::size_t k = 0; k < totals_.size(); ++k) burnish::add(totals_[k], steps[k], scans_);
  }
  scans_ += 1;
}

void SummedSteps::move_to(std::vector<Step>& steps) && {
  for (Step& step : totals_) steps.push_back(std::move(step));
}

ScanReader::ScanReader(const Scans& scans, const Recipe& recipe,
                       std::function<void(const PointCloud&)> see_raw)
    : scans_(scans), recipe_(recipe), see_raw_(std::move(see_raw)) {}

Result<Scan> ScanReader::read(std::size_t i, const Context& context) {
  context.stage(fmt::format("reading scan {} of {}", i + 1, scans_.size()));
  const auto start = std::chrono::steady_clock::now();
  Result<Scan> scan = scans_.read(i, context.part(0, 0.5));
  if (!scan) return scan;
  notes_.insert(notes_.end(), scan->notes.begin(), scan->notes.end());
  PointCloud& cloud = scan->cloud;
  if (recipe_.crop) {
    crop(cloud, *recipe_.crop);
    if (scan->raw) crop(*scan->raw, *recipe_.crop);
  }
  points_ += count_points(cloud);
  reading_.seconds +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  for (const Step& step : scan->steps) reading_.seconds -= step.seconds;
  on_frames_.add(scan->steps);
  see_raw_(scan->raw ? *scan->raw : cloud);
  if (cloud.grid) {
    Record single;
    if (auto clean = clean_cloud(cloud, recipe_.clean_scan, single, context.part(0.5, 1)); !clean) {
      return clean.error();
    }
    cleaning_.add(single.steps);
  }
  return scan;
}

Result<DepthFrame> ScanReader::read_frame(std::size_t i, const Context& context, bool counts) {
  if (!counts)
    return ScanReader(scans_, recipe_, [](const PointCloud&) {}).read_frame(i, context, true);
  Result<Scan> scan = read(i, context);
  if (!scan) return std::move(scan).error();
  if (!scan->frame) {
    return Error{ErrorCode::invalid_argument,
                 fmt::format("{} is made of depth frames, and this is a cloud: merge clouds with "
                             "cells, or give the frames that they are from",
                             recipe_.merge.name),
                 fmt::format("scan {}", i + 1)};
  }
  DepthFrame& frame = *scan->frame;
  for (std::size_t pixel = 0; pixel < frame.depth.size(); ++pixel) {
    if (!is_finite(scan->cloud.positions[pixel])) frame.depth[pixel] = 0;
  }
  return std::move(frame);
}

Result<void> ScanReader::finish(Record& record) {
  if (points_ == 0) {
    return Error{
        ErrorCode::bad_geometry,
        recipe_.crop ? "no point is left of the scans after cropping" : "the scans hold no point",
        {}};
  }
  record.notes.insert(record.notes.end(), notes_.begin(), notes_.end());
  reading_.facts = {{"scans", static_cast<double>(scans_.size()), ""},
                    {"points", static_cast<double>(points_), ""}};
  record.steps.push_back(std::move(reading_));
  std::move(on_frames_).move_to(record.steps);
  std::move(cleaning_).move_to(record.steps);
  return {};
}

Result<ReadFrames> ReadFrames::read_all(ScanReader& reader, const Context& context) {
  ReadFrames frames(reader);
  std::size_t bytes = 0;
  const double count = static_cast<double>(reader.size());
  for (std::size_t i = 0; i < reader.size(); ++i) {
    const double done = static_cast<double>(i);
    Result<DepthFrame> frame =
        reader.read_frame(i, context.part(done / count, (done + 1) / count), true);
    if (!frame) return std::move(frame).error();
    bytes += bytes_of(*frame);
    if (bytes <= kKeptBytes) frames.kept_.push_back(*std::move(frame));
  }
  return frames;
}

Result<DepthFrame> ReadFrames::read(std::size_t i, const Context& context) const {
  return i < kept_.size() ? Result<DepthFrame>(kept_[i]) : reader_->read_frame(i, context, false);
}

}  // namespace burnish
