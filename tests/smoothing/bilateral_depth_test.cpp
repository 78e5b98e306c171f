#include "burnish/smoothing/bilateral_depth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "burnish/sensor/virtual_camera.h"
#include "burnish/shapes/shapes.h"
#include "support/depth_scenes.h"

namespace burnish {
namespace {

using namespace test;

/// The header's formula for one pixel: a loop over all pixels of the image.
double reference(const DepthFrame& frame, const std::vector<double>& w, std::size_t i,
                 const BilateralDepthParams& params) {
  const int width = static_cast<int>(frame.camera.width);
  const int height = static_cast<int>(frame.camera.height);
  const int column = static_cast<int>(i) % width, row = static_cast<int>(i) / width;
  const double z = frame.depth[i];
  const double s = params.range * frame.noise_share_of(i) * frame.noise.axial(z, 0) / (z * z);
  const auto at = [&](int x, int y) {
    const bool inside = x >= 0 && y >= 0 && x < width && y < height;
    return inside ? w[static_cast<std::size_t>(y * width + x)] : 0;
  };
  double sum = 0, total = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double squared = (x - column) * (x - column) + (y - row) * (y - row);
      if (squared > 4 * params.spatial * params.spatial || at(x, y) == 0) continue;
      double apart = std::pow(at(x, y) - w[i], 2);
      if (params.symmetric) {
        const double opposite = at(2 * column - x, 2 * row - y);
        if (opposite == 0) continue;
        // The pixel itself is its own opposite, and as far from itself as it is.
        apart += std::pow(opposite - w[i], 2);
      }
      const double g = std::exp(-squared / (2 * params.spatial * params.spatial)) *
                       std::exp(-apart / (2 * s * s));
      sum += g * (at(x, y) - w[i]);
      total += g;
    }
  }
  return w[i] + sum / total;
}

std::vector<double> reference(const DepthFrame& frame, const BilateralDepthParams& params) {
  std::vector<double> w(frame.depth.size());
  for (std::size_t i = 0; i < w.size(); ++i) w[i] = frame.depth[i] > 0 ? 1.0 / frame.depth[i] : 0;
  for (int pass = 0; pass < params.iterations; ++pass) {
    std::vector<double> next = w;
    for (std::size_t i = 0; i < w.size(); ++i) {
      if (w[i] > 0) next[i] = reference(frame, w, i, params);
    }
    w = next;
  }
  for (double& value : w) value = value > 0 ? 1 / value : 0;
  return w;
}

void expect_the_formula(const DepthFrame& frame, const BilateralDepthParams& params) {
  DepthFrame filtered = frame;
  ASSERT_TRUE(smooth_bilateral_depth(filtered, params));
  const std::vector<double> expected = reference(frame, params);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_NEAR(filtered.depth[i], expected[i], 1e-6 * expected[i]) << "pixel " << i;
  }
}

/// Two surfaces with noise, a tenth of the pixels missing.
DepthFrame random_frame(std::uint64_t seed) {
  DepthFrame frame = empty_frame(33, 26);
  Random random(seed);
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    const double x = static_cast<double>(i % 33), y = static_cast<double>(i / 33);
    const double z = (x + 0.3 * y > 18 ? 1.0 : 1.02) + 0.0007 * x - 0.0004 * y;
    const double error = 0.0019 * random.normal();
    if (random.uniform() > 0.1) frame.depth[i] = static_cast<float>(z + error);
  }
  return frame;
}

TEST(BilateralDepth, IsTheFormulaOnRandomImages) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    DepthFrame frame = random_frame(seed);
    expect_the_formula(frame, {});
    expect_the_formula(frame, {.spatial = 1.3, .range = 3, .iterations = 1, .symmetric = false});
    Random random(seed);
    for (std::size_t i = 0; i < frame.depth.size(); ++i) {
      frame.noise_share.push_back(static_cast<float>(random.uniform(0.3, 1)));
    }
    expect_the_formula(frame, {.spatial = 2.2, .range = 2, .iterations = 3, .symmetric = true});
  }
}

TEST(BilateralDepth, IsTheFormulaOnAFrameOfTheVirtualCamera) {
  Sensor sensor = find_sensor("kinect_v1").value();
  sensor.camera = {64, 48, 59, 59, 31.5, 23.5};
  const auto camera = VirtualCamera::create(make_shape("torus").value(), sensor);
  ASSERT_TRUE(camera);
  const auto frame = camera->capture(look_at({0.4, 0.3, 0.4}, {0, 0, 0}, {0, 0, 1}));
  ASSERT_TRUE(frame);
  expect_the_formula(*frame, {});
}

/// A step across the middle of a frame at 1 m, of so many standard deviations, under white noise.
DepthFrame step_frame(double sigmas, double noise) {
  DepthFrame frame = empty_frame();
  const double sigma = frame.noise.axial(1, 0);
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    Random random(7, i);
    const double error = noise * sigma * random.normal();
    frame.depth[i] = static_cast<float>(1 + (i % 160 >= 80 ? sigmas * sigma : 0) + error);
  }
  return frame;
}

/// What is left of the step between the columns on its sides, in standard deviations.
double step_of(const DepthFrame& frame) {
  double step = 0;
  for (std::size_t row = 10; row < 110; ++row) {
    step += frame.depth[row * 160 + 80] - frame.depth[row * 160 + 79];
  }
  return step / 100 / frame.noise.axial(1, 0);
}

TEST(BilateralDepth, AStepOfFiveSigmaStaysAndOfOneGoes) {
  DepthFrame great = step_frame(5, 1), small = step_frame(1, 1);
  ASSERT_TRUE(smooth_bilateral_depth(great));
  ASSERT_TRUE(smooth_bilateral_depth(small));
  // The mean over a hundred rows of what is left of white noise errs by less than 0.05.
  EXPECT_GT(step_of(great), 0.88 * 5 - 0.05);
  EXPECT_LT(step_of(small), 0.25 + 0.05);
}

/// Root mean square of the error on a plane at 1 m, in standard deviations, away from the border.
double error_on_plane(const BilateralDepthParams& params) {
  DepthFrame frame = step_frame(0, 1);
  EXPECT_TRUE(smooth_bilateral_depth(frame, params));
  double sum = 0, count = 0;
  for (std::size_t row = 15; row < 105; ++row) {
    for (std::size_t column = 15; column < 145; ++column, ++count) {
      sum += std::pow(frame.depth[row * 160 + column] - 1.0, 2);
    }
  }
  return std::sqrt(sum / count) / frame.noise.axial(1, 0);
}

/// What one pass leaves of white noise of variance 1, where the window is large and `range` the
/// width over depth. For a pixel that errs by c, a pair (a, b) has the weight s exp(-((a - c)^2 +
/// (b - c)^2) / (2 k^2)), whose moments over normal a and b are known; then the mean over c.
double theory(double spatial, double k) {
  double sum = 0, pair_squares = 0;
  for (int y = -20; y <= 20; ++y) {
    for (int x = -20; x <= 20; ++x) {
      if (x * x + y * y > 4 * spatial * spatial || (x == 0 && y == 0)) continue;
      const double s = std::exp(-(x * x + y * y) / (2 * spatial * spatial));
      sum += s, pair_squares += s * s / 2;
    }
  }
  double left = 0, density = 0;
  for (double c = -5; c <= 5; c += 0.01) {
    const double k2 = k * k, weight = sum * k2 / (1 + k2) * std::exp(-c * c / (1 + k2));
    const double mean = c * (1 + weight / (1 + k2)) / (1 + weight);
    const double v = k2 / (k2 + 2), place = 2 * c / (k2 + 2);
    const double mass = v * std::exp(-2 * c * c / (k2 + 2));
    const double spread = pair_squares * mass * (2 * v + 4 * (place - mean) * (place - mean)) /
                          std::pow(1 + weight, 2);
    left += std::exp(-c * c / 2) * (mean * mean + spread);
    density += std::exp(-c * c / 2);
  }
  return std::sqrt(left / density);
}

TEST(BilateralDepth, TakesOutOfWhiteNoiseWhatTheoryPromises) {
  // 90 x 130 pixels, averaged over about 80 each, are 150 independent values: 6 % standard error.
  const double wide = error_on_plane({.spatial = 3, .range = 100, .iterations = 1});
  EXPECT_NEAR(wide, theory(3, 100), 0.15 * wide);
  for (const double range : {1.25, 2., 3.}) {
    const double narrow = error_on_plane({.spatial = 3, .range = range, .iterations = 1});
    EXPECT_NEAR(narrow, theory(3, range), 0.06 * narrow) << range;
  }
}

TEST(BilateralDepth, LeavesATiltedPlaneWithHolesWhereItIsUpToItsRims) {
  DepthFrame frame = empty_frame();
  fill(frame, plane(normalized(Vec3d{0.7, 0.3, 1}), 1));
  for (std::size_t row = 50; row < 60; ++row) {
    for (std::size_t column = 70; column < 90; ++column) frame.depth[row * 160 + column] = 0;
  }
  DepthFrame plain = frame, symmetric = frame;
  ASSERT_TRUE(smooth_bilateral_depth(symmetric));
  ASSERT_TRUE(smooth_bilateral_depth(plain, {.symmetric = false}));
  double bend = 0;
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    // Inverse depth is rounded to a float once a pass, depth once.
    EXPECT_NEAR(symmetric.depth[i], frame.depth[i], 3e-7 * frame.depth[i]) << i;
    bend = std::max(bend, std::abs(double{plain.depth[i]} - frame.depth[i]));
  }
  EXPECT_GT(bend, 0.5 * frame.noise.axial(1, 0));
}

TEST(BilateralDepth, MissingPixelsStayMissingAndCountForNothing) {
  DepthFrame frame = random_frame(4);
  const DepthFrame before = frame;
  ASSERT_TRUE(smooth_bilateral_depth(frame));
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    EXPECT_EQ(frame.depth[i] > 0, before.depth[i] > 0);
    EXPECT_EQ(frame.sigma_share[i] > 0, before.depth[i] > 0);
  }
  DepthFrame lonely = empty_frame(9, 7), nothing = lonely;
  lonely.depth[30] = 1.25f;
  ASSERT_TRUE(smooth_bilateral_depth(lonely));
  EXPECT_EQ(lonely.depth[30], 1.25f);
  EXPECT_EQ(lonely.sigma_share[30], 1.f);
  ASSERT_TRUE(smooth_bilateral_depth(nothing));
  EXPECT_EQ(nothing.depth, empty_frame(9, 7).depth);
}

TEST(BilateralDepth, LeavesTheDepthOfASensorWithoutNoise) {
  DepthFrame frame = random_frame(5);
  frame.noise = {};
  const std::vector<float> before = frame.depth;
  const auto report = smooth_bilateral_depth(frame);
  ASSERT_TRUE(report);
  EXPECT_EQ(frame.depth, before);
  EXPECT_EQ(report->max_move, 0);
}

struct Errors {
  double before, after, promised;
};

/// Root mean squares over the pixels of a virtual Kinect that see no edge.
Errors errors_of(const TriangleMesh& mesh, const RigidTransform& pose) {
  const Sensor sensor = find_sensor("kinect_v1").value();
  const VirtualCamera camera = VirtualCamera::create(mesh, sensor).value();
  const DepthFrame truth = camera.capture(pose, {.noise = 0}).value();
  const DepthFrame noisy = camera.capture(pose).value();
  DepthFrame filtered = noisy;
  EXPECT_TRUE(smooth_bilateral_depth(filtered));
  Errors sum{};
  double count = 0;
  for (std::size_t i = 0; i < truth.depth.size(); ++i) {
    const double z = truth.depth[i], sigma = sensor.noise.axial(z, 0);
    const double error = noisy.depth[i] - z;
    if (!(z > 0 && noisy.depth[i] > 0) || std::abs(error) > 5 * sigma) continue;
    sum.before += std::pow(error / sigma, 2);
    sum.after += std::pow((filtered.depth[i] - z) / sigma, 2);
    sum.promised += std::pow(filtered.sigma_share[i], 2);
    ++count;
  }
  return {std::sqrt(sum.before / count), std::sqrt(sum.after / count),
          std::sqrt(sum.promised / count)};
}

TEST(BilateralDepth, BringsFramesOfTheVirtualCameraNearerToTheTruthAndPromisesNoMore) {
  const Errors room =
      errors_of(make_box({4, 3, 3}, 20), look_at({-1.5, 0.2, 0.3}, {1, 0, 0}, {0, 0, 1}));
  EXPECT_LT(room.after, 0.55 * room.before);
  EXPECT_LT(room.after, room.promised * room.before);
  EXPECT_LT(room.promised, 0.8);
  const Errors torus =
      errors_of(make_shape("torus").value(), look_at({0.5, 0.4, 0.5}, {0, 0, 0}, {0, 0, 1}));
  EXPECT_LT(torus.after, 0.75 * torus.before);
  EXPECT_LT(torus.after, torus.promised * torus.before);
}

TEST(BilateralDepth, RefusesWhatCannotBeAndLeavesTheFrame) {
  DepthFrame frame = random_frame(6);
  frame.depth[5] = -1;
  const DepthFrame before = frame;
  const auto refused = smooth_bilateral_depth(frame);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::bad_geometry);
  EXPECT_EQ(frame, before);
  EXPECT_FALSE(smooth_bilateral_depth(frame, {.spatial = 0}));
}

}  // namespace
}  // namespace burnish
