#include "burnish/sensor/virtual_camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "burnish/sensor/image_noise.h"
#include "burnish/shapes/shapes.h"

namespace burnish {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Sum over all pixel distances of the squared correlation of the noise, for .46 exp(-d^2/4) +
/// .22 exp(-d^2/100) and the white rest: 1 + 1.3 + 2.5 + 7.6. An estimate from N pixels is as good
/// as one from N / kCluster independent ones.
constexpr double kCluster = 12.4;
/// The same for noise that is blurred by two pixels: 4 pi 2^2.
constexpr double kPatch = 50;

Sensor small_sensor() {
  Sensor sensor = find_sensor("kinect_v1").value();
  Camera& c = sensor.camera;
  c = {80, 60, c.fx / 8, c.fy / 8, 39.5, 29.5};
  return sensor;
}

// The exact camera.

TEST(VirtualCamera, WithoutNoiseAPlaneIsExact) {
  // A wide plane through (0, 0, 1.5) with a normal that leans both ways.
  TriangleMesh mesh = make_grid(40, 40, 0.5);
  const Vec3d normal = normalized(Vec3d{0.3, -0.4, -1});
  for (Vec3f& p : mesh.positions) {
    const double x = p.x - 10, y = p.y - 10;
    p = Vec3f(Vec3d{x, y, 1.5 - (normal.x * x + normal.y * y) / normal.z});
  }
  const Sensor sensor = small_sensor();
  const auto camera = VirtualCamera::create(mesh, sensor);
  ASSERT_TRUE(camera) << camera.error().text();
  const auto frame = camera->capture({}, {.noise = 0});
  ASSERT_TRUE(frame) << frame.error().text();
  for (std::uint32_t v = 0; v < 60; ++v) {
    for (std::uint32_t u = 0; u < 80; ++u) {
      const double z = normal.z * 1.5 / dot(normal, sensor.camera.unproject(u, v, 1));
      // The mesh's corners, 10 m away, are rounded to float by 2^-21; so is depth, by less.
      EXPECT_NEAR(frame->depth[v * 80 + u], z, 1e-6);
    }
  }
}

TEST(VirtualCamera, WithoutNoiseASphereIsExactBetweenItsFacets) {
  const double radius = 0.2;
  const TriangleMesh mesh = make_sphere(radius, 5);
  // Facets are chords: their middles lie deeper by the height of an arc of the longest edge.
  double longest = 0;
  for (const Triangle& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      longest = std::max(longest,
                         norm(Vec3d(mesh.positions[t[i]]) - Vec3d(mesh.positions[t[(i + 1) % 3]])));
    }
  }
  const double sag = longest * longest / (6 * radius);  // circumradius e / sqrt(3), arc e^2 / (6 r)
  const auto camera = VirtualCamera::create(mesh, small_sensor());
  ASSERT_TRUE(camera);
  const RigidTransform pose = look_at({0.5, 0.4, 0.3}, {0, 0, 0}, {0, 0, 1});
  const auto frame = camera->capture(pose, {.noise = 0});
  ASSERT_TRUE(frame);
  int seen = 0;
  for (std::uint32_t v = 0; v < 60; ++v) {
    for (std::uint32_t u = 0; u < 80; ++u) {
      const Vec3d ray = normalized(pose.rotate(frame->camera.unproject(u, v, 1)));
      const double along = -dot(ray, pose.translation);
      const double apart = std::sqrt(squared_norm(pose.translation) - along * along);
      const double z = frame->depth[v * 80 + u];
      if (z == 0) {
        EXPECT_GT(apart, radius - sag - 1e-6);
        continue;
      }
      ++seen;
      const double from_centre = norm(pose(frame->camera.unproject(u, v, z)));
      EXPECT_LT(from_centre, radius + 1e-7);
      EXPECT_GT(from_centre, radius - sag - 1e-7);
      EXPECT_LT(apart, radius + 1e-7);
    }
  }
  EXPECT_GT(seen, 500);
}

TEST(VirtualCamera, TheFramesOriginIsAdded) {
  TriangleMesh mesh = make_sphere(0.2, 3);
  const RigidTransform pose = look_at({0.7, 0, 0}, {0, 0, 0}, {0, 0, 1});
  const auto here = VirtualCamera::create(mesh, small_sensor())->capture(pose, {.noise = 0});
  mesh.frame.origin = {512, -1024, 2048};
  RigidTransform there = pose;
  there.translation += mesh.frame.origin;
  const auto far = VirtualCamera::create(mesh, small_sensor())->capture(there, {.noise = 0});
  for (std::size_t i = 0; i < here->depth.size(); ++i) {
    EXPECT_NEAR(here->depth[i], far->depth[i], 1e-6);
  }
}

TEST(VirtualCamera, WhatCannotBeIsRefused) {
  EXPECT_EQ(VirtualCamera::create({}, small_sensor()).error().code, ErrorCode::bad_geometry);
  Sensor blind = small_sensor();
  blind.camera.fx = 0;
  EXPECT_FALSE(VirtualCamera::create(make_sphere(), blind));
  const auto camera = VirtualCamera::create(make_sphere(), small_sensor());
  EXPECT_FALSE(camera->capture({}, {.noise = -1}));
  RigidTransform skewed;
  skewed.rows[0] = {2, 0, 0};
  EXPECT_EQ(camera->capture(skewed).error().code, ErrorCode::invalid_argument);
  std::stop_source stop;
  stop.request_stop();
  Context context;
  context.stop = stop.get_token();
  EXPECT_EQ(camera->capture({}, {}, context).error().code, ErrorCode::cancelled);
}

TEST(VirtualCamera, TheProjectorCastsAShadowToTheLeft) {
  // A plate at 1 m, 0.3 m wide, before a wall at 2 m.
  TriangleMesh scene = make_box({10, 10, 0.01});
  for (Vec3f& p : scene.positions) p.z += 2.005f;
  const TriangleMesh plate = make_box({0.3, 0.3, 0.002});
  const auto first = static_cast<std::uint32_t>(scene.positions.size());
  for (const Vec3f& p : plate.positions) scene.positions.push_back({p.x, p.y, p.z + 1.001f});
  for (const Triangle& t : plate.triangles) {
    scene.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  const Sensor sensor = find_sensor("kinect_v1").value();
  // So little noise that only the loss of pixels is left of it.
  const auto frame = VirtualCamera::create(scene, sensor)->capture({}, {.noise = 1e-6});
  ASSERT_TRUE(frame);
  const float* row = frame->depth.data() + 240 * 640;
  const double left = 319.5 - sensor.camera.fx * 0.15, right = 319.5 + sensor.camera.fx * 0.15;
  const double shadow = left - sensor.camera.fx * 0.075 * (1 / 1.0 - 1 / 2.0);
  for (int u = 0; u < 640; ++u) {
    // Beside edges pixels are lost by chance.
    if (std::min({std::abs(u - left), std::abs(u - right), std::abs(u - shadow)}) < 2) continue;
    EXPECT_EQ(row[u] == 0, u > shadow && u < left) << u;
  }
}

// The noise, on images of which every pixel sees the same.

/// Distances that differ by one disparity step from the first to the last row, so that where the
/// steps lie does not matter.
std::vector<Sight> flat(const Sensor& sensor, double z, double incidence) {
  const std::size_t width = sensor.camera.width, height = sensor.camera.height;
  std::vector<Sight> sights(width * height);
  for (std::size_t i = 0; i < sights.size(); ++i) {
    const double share = static_cast<double>(i / width) / static_cast<double>(height) - 0.5;
    sights[i] = {z + share * sensor.disparity_step * z * z, static_cast<float>(incidence), true};
  }
  return sights;
}

/// Measured minus true depth; 0 where nothing was measured.
std::vector<double> residuals(const Sensor& sensor, const std::vector<Sight>& sights,
                              const CaptureParams& params = {}) {
  const auto depth = disturb(sensor, sights, params, {});
  std::vector<double> result(sights.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    if ((*depth)[i] > 0) result[i] = (*depth)[i] - sights[i].depth;
  }
  return result;
}

double mean_product(const std::vector<double>& image, std::size_t width, std::size_t lag) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (i % width + lag >= width) continue;
    sum += image[i] * image[i + lag];
    ++count;
  }
  return sum / static_cast<double>(count);
}

TEST(Disturbance, HasTheAxialSigmaOfThePaper) {
  Sensor sensor = find_sensor("kinect_v1").value();
  sensor.noise.max_depth = 0;
  const double pixels = 640 * 480;
  const std::pair<double, double> places[] = {{0.6, 0}, {1, 45}, {2, 64}, {4, 0}};
  for (const auto& [z, degrees] : places) {
    const auto errors = residuals(sensor, flat(sensor, z, degrees * kDegree));
    const double variance = mean_product(errors, 640, 0);
    const double expected = std::pow(sensor.noise.axial(z, degrees * kDegree), 2);
    // Four standard deviations of a variance estimated from as many independent values.
    EXPECT_NEAR(variance / expected, 1, 4 * std::sqrt(2 * kCluster / pixels))
        << z << " " << degrees;
  }
}

TEST(Disturbance, OfOtherSensorsToo) {
  for (const char* name : {"kinect_v2", "azure_kinect"}) {
    const Sensor sensor = find_sensor(name).value();
    const auto errors = residuals(sensor, flat(sensor, 2, 0.3));
    const double expected = std::pow(sensor.noise.axial(2, 0.3), 2);
    EXPECT_NEAR(mean_product(errors, sensor.camera.width, 0) / expected, 1,
                4 * std::sqrt(2 * kCluster / double(errors.size())))
        << name;
  }
}

TEST(Disturbance, NeighboursErrAlikeAsOnARealKinect) {
  const Sensor sensor = find_sensor("kinect_v1").value();
  const auto errors = residuals(sensor, flat(sensor, 1, 0));
  const double variance = mean_product(errors, 640, 0);
  // Measured on the Pyramid frame at 1, 2, 3, 4 and 6 pixels; the model is within .016 of that, the
  // estimate within four times sqrt(kCluster / pixels).
  const std::pair<std::size_t, double> measured[] = {
      {1, .58}, {2, .37}, {3, .25}, {4, .21}, {6, .165}};
  for (const auto& [lag, correlation] : measured) {
    EXPECT_NEAR(mean_product(errors, 640, lag) / variance, correlation,
                0.016 + 4 * std::sqrt(kCluster / (640 * 480)))
        << lag;
  }
}

TEST(Disturbance, ScalesWithNoise) {
  const Sensor sensor = find_sensor("kinect_v1").value();
  const double full = mean_product(residuals(sensor, flat(sensor, 1, 0)), 640, 0);
  const double half = mean_product(residuals(sensor, flat(sensor, 1, 0), {.noise = 0.5}), 640, 0);
  // The same draws, but for where the steps fall.
  EXPECT_NEAR(half / full, 0.25, 0.25 * 0.02);
  const auto none = residuals(sensor, flat(sensor, 1, 0), {.noise = 0});
  for (const double error : none) ASSERT_NEAR(error, 0, 6e-8);  // rounding to float
}

TEST(Disturbance, DepthsLieOnDisparitySteps) {
  const Sensor sensor = find_sensor("kinect_v1").value();
  const auto depth = disturb(sensor, flat(sensor, 1.5, 0), {}, {});
  for (const float z : *depth) {
    const double steps = 1 / (z * sensor.disparity_step);
    ASSERT_NEAR(steps, std::round(steps), 1e-4);  // 234 steps, each rounded to float
  }
}

TEST(Disturbance, GrazingViewsAreLostMoreAndMore) {
  const Sensor sensor = find_sensor("kinect_v1").value();
  for (const double degrees : {60.0, 76.0, 80.0, 89.0}) {
    const auto depth = disturb(sensor, flat(sensor, 1, degrees * kDegree), {}, {});
    const double lost =
        double(std::count(depth->begin(), depth->end(), 0.f)) / double(depth->size());
    const double expected = 0.5 * std::erfc((80 - degrees) / 4 / std::sqrt(2.0));
    EXPECT_NEAR(lost, expected, 4 * std::sqrt(0.25 * kPatch / (640 * 480))) << degrees;
  }
}

TEST(Disturbance, OutlinesFrayByTheLateralSigma) {
  const Sensor sensor = find_sensor("kinect_v1").value();
  std::vector<Sight> sights(640 * 480);
  // Stripes of a surface at 1 m: columns 5 to 9 of every 10.
  for (std::size_t i = 0; i < sights.size(); ++i) {
    if (i % 10 >= 5) sights[i].depth = 1;
  }
  const auto depth = disturb(sensor, sights, {}, {});
  // Share of the pixels of such a column that measure the surface.
  const double rows = 480 * 64;
  const auto share = [&](std::size_t column) {
    double seen = 0;
    for (std::size_t i = 0; i < depth->size(); ++i) seen += i % 10 == column && (*depth)[i] > 0;
    return seen / rows;
  };
  const double tolerance = 4 * std::sqrt(0.25 * kPatch / rows);
  // Shifts are N(0, 0.8 px) rounded to pixels; a quarter of the pixels beside an edge is lost.
  const auto beyond = [](double pixels) { return 0.5 * std::erfc(pixels / 0.8 / std::sqrt(2.0)); };
  EXPECT_NEAR(share(4), 0.75 * beyond(0.5), tolerance);
  EXPECT_NEAR(share(5), 0.75 * (1 - beyond(0.5)), tolerance);
  EXPECT_NEAR(share(3), beyond(1.5), tolerance);
  EXPECT_NEAR(share(6), 1 - beyond(1.5), tolerance);
  EXPECT_EQ(share(2), 0);
  EXPECT_EQ(share(7), 1);
}

TEST(Disturbance, OutOfRangeIsNoDepth) {
  const Sensor sensor = find_sensor("kinect_v1").value();
  for (const double z : {0.3, 5.0}) {
    for (const double noise : {0.0, 1.0}) {
      const auto depth =
          disturb(sensor, std::vector<Sight>(640 * 480, Sight{z, 0, true}), {.noise = noise}, {});
      EXPECT_EQ(std::count(depth->begin(), depth->end(), 0.f), 640 * 480) << z;
    }
  }
}

}  // namespace
}  // namespace burnish
