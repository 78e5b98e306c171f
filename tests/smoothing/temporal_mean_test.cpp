#include "burnish/smoothing/temporal_mean.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "burnish/sensor/virtual_camera.h"
#include "burnish/shapes/shapes.h"
#include "support/depth_scenes.h"

namespace burnish {
namespace {

using namespace test;

/// Frames of a wavy wall: noise, a tenth of the depths missing, one in twenty far too near.
std::vector<DepthFrame> random_frames(std::size_t count, std::uint64_t seed) {
  std::vector<DepthFrame> frames;
  for (std::size_t f = 0; f < count; ++f) {
    DepthFrame frame = empty_frame(40, 30);
    frame.time = static_cast<double>(f);
    Random random(seed, f);
    for (std::size_t i = 0; i < frame.depth.size(); ++i) {
      const double z = 1.2 + 0.1 * std::sin(0.3 * static_cast<double>(i % 40));
      double depth = z + 0.002 * random.normal();
      const double chance = random.uniform();
      if (chance < 0.05) depth -= 0.3 * random.uniform();
      if (chance < 0.9) frame.depth[i] = static_cast<float>(depth);
      frame.noise_share.push_back(static_cast<float>(random.uniform(0.4, 1)));
    }
    frames.push_back(std::move(frame));
  }
  return frames;
}

struct Expected {
  double depth = 0, share = 0;
  std::uint32_t observations = 0;
};

/// The header's words for one pixel.
Expected reference(const std::vector<DepthFrame>& frames, std::size_t i,
                   const TemporalMeanParams& params) {
  std::vector<double> agreeing;
  for (const DepthFrame& frame : frames) {
    if (frame.depth[i] > 0) agreeing.push_back(frame.depth[i]);
  }
  if (agreeing.empty()) return {};
  double sigma = 0, median = 0;
  const auto counts = [&](const DepthFrame& frame) {
    const double reach = params.outlier * sigma * frame.noise_share[i];
    return frame.depth[i] > 0 && std::abs(frame.depth[i] - median) <= reach;
  };
  for (int round = 0; round < 2 && !agreeing.empty(); ++round) {
    std::sort(agreeing.begin(), agreeing.end());
    median = (agreeing[(agreeing.size() - 1) / 2] + agreeing[agreeing.size() / 2]) / 2;
    sigma = frames.front().noise.axial(median, 0);
    agreeing.clear();
    for (const DepthFrame& frame : frames) {
      if (counts(frame)) agreeing.push_back(frame.depth[i]);
    }
  }
  double weights = 0, depths = 0, variances = 0, squares = 0;
  std::uint32_t count = 0;
  for (const DepthFrame& frame : frames) {
    const double s = sigma * frame.noise_share[i];
    if (!counts(frame)) continue;
    ++count;
    weights += 1 / (s * s);
    depths += frame.depth[i] / (s * s);
  }
  if (count == 0 || count < params.least_share * static_cast<double>(frames.size())) return {};
  for (const DepthFrame& frame : frames) {
    const double s = sigma * frame.noise_share[i], w = 1 / (s * s) / weights;
    if (!counts(frame)) continue;
    variances += w * s * s;
    squares += w * w * s * s;
  }
  const double left = params.repeated * variances + (1 - params.repeated) * squares;
  return {depths / weights, std::sqrt(left) / sigma, count};
}

TEST(TemporalMean, IsWhatTheHeaderSaysOnRandomFrames) {
  for (const std::size_t count : {1, 2, 5, 12}) {
    const auto frames = random_frames(count, count);
    for (const TemporalMeanParams& params :
         {TemporalMeanParams{}, TemporalMeanParams{2, 0.8, 0}, TemporalMeanParams{100, 0, 1}}) {
      const auto mean = temporal_mean(frames, params);
      ASSERT_TRUE(mean) << mean.error().text();
      ASSERT_TRUE(check(mean->frame));
      for (std::size_t i = 0; i < 1200; ++i) {
        const Expected expected = reference(frames, i, params);
        ASSERT_NEAR(mean->frame.depth[i], expected.depth, 1e-7 * expected.depth) << i;
        ASSERT_NEAR(mean->frame.noise_share[i], expected.share, 1e-6) << i;
        ASSERT_EQ(mean->frame.observations[i], expected.observations) << i;
      }
      EXPECT_EQ(mean->frame.time, frames.back().time);
      EXPECT_TRUE(mean->frame.sigma_share.empty());
    }
  }
}

TEST(TemporalMean, WhiteNoiseFallsByTheRootOfTheCountAndSigmaNoLowerThanWhatRepeats) {
  std::vector<DepthFrame> frames(16, empty_frame());
  for (std::size_t f = 0; f < frames.size(); ++f) fill(frames[f], plane({0, 0, 1}, 1), 1, f + 1);
  const auto mean = temporal_mean(frames);
  ASSERT_TRUE(mean);
  double sum = 0;
  for (std::size_t i = 0; i < mean->frame.depth.size(); ++i) {
    sum += std::pow(mean->frame.depth[i] - 1.0, 2);
    const double n = mean->frame.observations[i];
    EXPECT_NEAR(mean->frame.noise_share[i], std::sqrt(0.25 + 0.75 / n), 1e-6);
  }
  const double error = std::sqrt(sum / 19200) / frames[0].noise.axial(1, 0);
  // 19200 independent pixels: 0.5 % standard error. To cut at 3 deviations costs 1.5 % (the
  // efficiency of a mean that forgets the tails), with few samples a little more.
  EXPECT_GT(error, 0.985 * 0.25);
  EXPECT_LT(error, 1.04 * 0.25);
  EXPECT_NEAR(mean->report.mean_count, 16 * 0.9973, 0.05);
}

TEST(TemporalMean, WhatMovesThroughLeavesNoTrace) {
  std::vector<DepthFrame> frames(9, empty_frame());
  for (std::size_t f = 0; f < frames.size(); ++f) {
    fill(frames[f], plane({0, 0, 1}, 2), 1, f + 1);
    // A hand, 30 columns wide, that goes on by ten columns a frame: before a pixel in three frames.
    for (std::size_t i = 0; i < frames[f].depth.size(); ++i) {
      if (i % 160 >= 10 * f && i % 160 < 10 * f + 30) frames[f].depth[i] = 0.8f;
    }
  }
  const auto mean = temporal_mean(frames);
  ASSERT_TRUE(mean);
  const double sigma = frames[0].noise.axial(2, 0);
  std::size_t lost = 0;
  for (const float depth : mean->frame.depth) {
    if (depth == 0) {
      ++lost;
    } else {
      EXPECT_NEAR(depth, 2, 4 * sigma);
    }
  }
  EXPECT_LT(lost, 40u);  // two thousandths, where two of the six that agree err by much
  EXPECT_GT(mean->report.outliers, 9u * 30 * 120 * 9 / 10);
}

TEST(TemporalMean, DropsPixelsOnWhichTooFewFramesAgree) {
  std::vector<DepthFrame> frames(4, empty_frame(3, 1));
  const std::vector<std::vector<float>> depths{{1, 1, 1}, {1, 2, 0}, {0, 2, 0}, {0, 3, 2}};
  for (std::size_t f = 0; f < 4; ++f) frames[f].depth = depths[f];
  const auto mean = temporal_mean(frames);
  ASSERT_TRUE(mean);
  EXPECT_EQ(mean->frame.depth, (std::vector<float>{1, 2, 0}));
  EXPECT_EQ(mean->frame.observations, (std::vector<std::uint32_t>{2, 2, 0}));
  EXPECT_EQ(mean->report.pixels, 2u);
  EXPECT_EQ(mean->report.dropped_pixels, 1u);
  EXPECT_EQ(mean->report.outliers, 4u);  // the median of 1 and 2 is near to neither
}

TEST(TemporalMean, OfOneFrameIsThatFrame) {
  const auto frames = random_frames(1, 3);
  const auto mean = temporal_mean(frames);
  ASSERT_TRUE(mean);
  EXPECT_EQ(mean->frame.depth, frames[0].depth);
}

TEST(TemporalMean, RefusesFramesFromElsewhereAndNone) {
  auto frames = random_frames(3, 1);
  frames[2].T_world_camera.translation.x = 1e-9;
  const auto moved = temporal_mean(frames);
  ASSERT_FALSE(moved);
  EXPECT_EQ(moved.error().code, ErrorCode::bad_geometry);
  EXPECT_EQ(moved.error().where, "frame 3 of 3");
  EXPECT_EQ(temporal_mean({}).error().code, ErrorCode::invalid_argument);
  frames[2] = frames[1];
  frames[1].depth[7] = -1;
  EXPECT_EQ(temporal_mean(frames).error().where, "frame 2 of 3");
}

TEST(TemporalWindow, IsTheMeanOfTheLastFramesFromOnePlace) {
  auto frames = random_frames(7, 2);
  TemporalWindow window(3);
  for (const DepthFrame& frame : frames) window.add(frame);
  EXPECT_EQ(window.size(), 3u);
  const auto mean = window.mean();
  ASSERT_TRUE(mean);
  EXPECT_EQ(mean->frame, temporal_mean(std::span(frames).last(3))->frame);
  frames[0].T_world_camera.translation.y = 1;
  window.add(frames[0]);
  EXPECT_EQ(window.size(), 1u);
}

TEST(TemporalMean, BringsAFixedVirtualCameraNearerToTheTruth) {
  Sensor sensor = find_sensor("kinect_v1").value();
  sensor.camera = {213, 160, 196, 196, 106, 79.5};
  const auto camera = VirtualCamera::create(make_shape("torus").value(), sensor);
  ASSERT_TRUE(camera);
  const RigidTransform pose = look_at({0.5, 0.4, 0.5}, {0, 0, 0}, {0, 0, 1});
  const DepthFrame truth = camera->capture(pose, {.noise = 0}).value();
  std::vector<DepthFrame> frames;
  for (std::uint64_t view = 0; view < 16; ++view) {
    frames.push_back(camera->capture(pose, {.view = view}).value());
  }
  const auto mean = temporal_mean(frames);
  ASSERT_TRUE(mean);
  const auto error = [&](const DepthFrame& frame) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < truth.depth.size(); ++i) {
      if (!(truth.depth[i] > 0 && mean->frame.depth[i] > 0 && frame.depth[i] > 0)) continue;
      sum += std::pow(std::min(0.02, std::abs(double{frame.depth[i]} - truth.depth[i])), 2);
      ++count;
    }
    return std::sqrt(sum / count);
  };
  // Its noise is drawn anew for every frame but for the steps of disparity and the outlines.
  EXPECT_LT(error(mean->frame), 0.4 * error(frames[0]));
}

}  // namespace
}  // namespace burnish
