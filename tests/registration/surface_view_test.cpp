#include "burnish/registration/surface_view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/depth_scenes.h"
#include "support/threads.h"

namespace burnish {
namespace {

const Vec3d kNormal = normalized(Vec3d{0.3, -0.2, -1});

DepthFrame tilted_plane(double noise) {
  DepthFrame frame = test::empty_frame();
  test::fill(frame, test::plane(kNormal, dot(kNormal, Vec3d{0, 0, 1.5})), noise);
  return frame;
}

TEST(SurfaceView, KnowsPlanesExactly) {
  const DepthFrame frame = tilted_plane(0);
  const SurfaceView view = surface_view(frame).value();
  std::size_t normals = 0;
  for (std::size_t i = 0; i < view.pixels.size(); ++i) {
    const SurfacePixel& pixel = view.pixels[i];
    const double u = static_cast<double>(i % 160), v = static_cast<double>(i / 160);
    EXPECT_LT(norm(Vec3d(pixel.position) - frame.camera.unproject(u, v, frame.depth[i])), 1e-6);
    if (squared_norm(pixel.normal) == 0) continue;
    ++normals;
    // Depth is rounded to float: slopes of 1/z over eight pixels err by 1e-7 / (8 / 146).
    EXPECT_LT(norm(Vec3d(pixel.normal) - kNormal), 1e-5);
  }
  EXPECT_EQ(normals, (160u - 8) * (120 - 8));  // a window of 4 ends at the rim
}

TEST(SurfaceView, ErrorsAreTheSensorsSeenThroughTheNormal) {
  const SurfaceView view = surface_view(tilted_plane(0), {.distortion = 0.003}).value();
  const SurfacePixel& pixel = view.pixels[60 * 160 + 80];
  const Vec3d ray(pixel.position);
  const double z = ray.z, cosine = -dot(normalized(ray), kNormal);
  EXPECT_NEAR(pixel.sigma, (0.0012 + 0.0019 * (z - 0.4) * (z - 0.4)) * cosine, 1e-6);
  EXPECT_NEAR(pixel.bias, 0.003 * z * z * cosine, 1e-6);
}

TEST(SurfaceView, NormalsOfANoisyPlaneScatterByAFewDegrees) {
  const SurfaceView view = surface_view(tilted_plane(1)).value();
  double sum = 0, count = 0;
  for (const SurfacePixel& pixel : view.pixels) {
    if (squared_norm(pixel.normal) == 0) continue;
    sum += std::pow(norm(Vec3d(pixel.normal) - kNormal), 2);
    count += 1;
  }
  // A central difference over 8 pixels, 9 of them: sqrt(2 / 9) sigma / (8 z / fx), of either axis.
  const double slope = std::sqrt(2.0 / 9) * 0.0035 / (8 * 1.5 / 146);
  EXPECT_GT(count, 15000);
  EXPECT_NEAR(std::sqrt(sum / count), std::sqrt(2.0) * slope, 0.3 * slope);
}

TEST(SurfaceView, EdgesAndMissingPixelsHaveNoNormal) {
  DepthFrame frame = test::empty_frame();
  const double step = 0.2;
  test::fill(frame, [&](const Vec3d& ray) { return ray.x < 0 ? 1.5 : 1.5 + step; });
  frame.depth[10 * 160 + 10] = 0;
  frame.depth[10 * 160 + 30] = 9;  // beyond the sensor's range
  const SurfaceView view = surface_view(frame).value();
  const auto has_normal = [&](std::size_t column, std::size_t row) {
    return squared_norm(view.pixels[row * 160 + column].normal) > 0;
  };
  for (std::size_t column : {76u, 79u, 80u, 83u}) EXPECT_FALSE(has_normal(column, 60));
  EXPECT_TRUE(has_normal(75, 60));
  EXPECT_TRUE(has_normal(84, 60));
  EXPECT_EQ(view.pixels[10 * 160 + 10].position.z, 0);
  EXPECT_EQ(view.pixels[10 * 160 + 30].position.z, 0);
  EXPECT_FALSE(has_normal(30, 10));
}

TEST(SurfaceView, RefusesWhatCannotBe) {
  DepthFrame frame = tilted_plane(0);
  EXPECT_EQ(surface_view(frame, {.window = 0}).error().code, ErrorCode::invalid_argument);
  frame.depth[7] = NAN;
  EXPECT_EQ(surface_view(frame).error().code, ErrorCode::bad_geometry);
  Context stopped;
  std::stop_source stop;
  stop.request_stop();
  stopped.stop = stop.get_token();
  EXPECT_EQ(surface_view(tilted_plane(0), {}, stopped).error().code, ErrorCode::cancelled);
}

TEST(SurfaceView, SameBytesForAnyNumberOfThreads) {
  const DepthFrame frame = tilted_plane(1);
  const SurfaceView one = surface_view(frame, {}, test::with_threads(1)).value();
  const SurfaceView many = surface_view(frame, {}, test::with_threads(3)).value();
  for (std::size_t i = 0; i < one.pixels.size(); ++i) {
    ASSERT_EQ(one.pixels[i].normal, many.pixels[i].normal);
    ASSERT_EQ(one.pixels[i].sigma, many.pixels[i].sigma);
  }
}

}  // namespace
}  // namespace burnish
