#include "burnish/triangulation/fuse_volume.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "burnish/core/topology.h"
#include "burnish/sensor/virtual_camera.h"
#include "burnish/shapes/shapes.h"
#include "support/depth_scenes.h"
#include "support/progress.h"

namespace burnish {
namespace {

constexpr double kRadius = 0.15, kAway = 0.7, kVoxel = 0.005;

/// Views of a Kinect of a quarter of the size from all around. Its model has no lateral noise: the
/// virtual camera shifts nothing within a surface.
std::vector<DepthFrame> views_of(const TriangleMesh& mesh, int count, double noise) {
  Sensor sensor = *find_sensor("kinect_v1");
  sensor.camera = {160, 120, 170, 170, 79.5, 59.5};
  sensor.noise.pixels = sensor.noise.pixels_grazing = 0;
  const auto camera = VirtualCamera::create(mesh, sensor);
  std::vector<DepthFrame> frames;
  for (int i = 0; i < count; ++i) {
    // Evenly over the sphere of directions (a Fibonacci lattice).
    const double z = 1 - (2 * i + 1.0) / count, turn = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const double r = std::sqrt(1 - z * z);
    const Vec3d eye = Vec3d{r * std::cos(turn), r * std::sin(turn), z} * kAway;
    const Vec3d up = std::abs(z) < 0.9 ? Vec3d{0, 0, 1} : Vec3d{1, 0, 0};
    CaptureParams how{.noise = noise};
    how.view = static_cast<std::uint64_t>(i);
    frames.push_back(camera->capture(look_at(eye, {}, up), how).value());
  }
  return frames;
}

const std::vector<DepthFrame>& sphere_views() {
  static const auto frames = views_of(make_sphere(kRadius, 5), 24, 1);
  return frames;
}

FusedVolume fused(std::span<const DepthFrame> frames, const VolumeParams& params = {kVoxel},
                  const Context& context = {}) {
  auto result = fuse_volume(FramesInMemory(frames), params, context);
  if (!result) throw std::runtime_error(result.error().text());
  return *std::move(result);
}

void expect_manifold(const TriangleMesh& mesh) {
  ASSERT_TRUE(check(mesh));
  const Topology t = topology(mesh);
  EXPECT_EQ(t.non_manifold_edges, 0u);
  EXPECT_EQ(t.flipped_edges, 0u);
  EXPECT_EQ(t.degenerate_triangles, 0u);
  EXPECT_EQ(t.duplicate_triangles, 0u);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    ASSERT_GT(squared_norm(area_vector(mesh, i)), 0) << "triangle " << i << " has no area";
  }
}

/// Without noise what is left is the bend of the sphere within a patch: at most that of two pixels
/// seen at 60 degrees, w^2 / (8 radius).
TEST(FuseVolume, FindsASphereWithinItsBend) {
  const auto frames = views_of(make_sphere(kRadius, 5), 24, 0);
  const FusedVolume result = fused(frames);
  expect_manifold(result.mesh);
  EXPECT_TRUE(topology(result.mesh).closed());
  EXPECT_EQ(topology(result.mesh).components, 1u);
  double squares = 0;
  for (const Vec3f& p : result.mesh.positions) squares += std::pow(norm(Vec3d(p)) - kRadius, 2);
  const double rms = std::sqrt(squares / static_cast<double>(result.mesh.positions.size()));
  const double wide = 2 * (kAway - kRadius) / 170 / std::cos(std::numbers::pi / 3);
  EXPECT_LT(rms, wide * wide / (8 * kRadius));
  for (std::size_t i = 0; i < result.mesh.positions.size(); ++i) {
    EXPECT_GT(dot(result.mesh.attributes.normals[i], result.mesh.positions[i]), 0);
  }
}

/// Errors in units of what the mesh says of them. A fifth of the variance comes of the bend within
/// patches (above) and is no noise.
TEST(FuseVolume, SaysHowFarToTrustEveryVertex) {
  const FusedVolume result = fused(sphere_views(), {});
  expect_manifold(result.mesh);
  const Attributes& attributes = result.mesh.attributes;
  double squares = 0, in_sigmas = 0, count = 0;
  for (std::size_t i = 0; i < result.mesh.positions.size(); ++i) {
    ASSERT_GT(attributes.sigma[i], 0);
    ASSERT_GE(attributes.observations[i], 1u);
    const double error = norm(Vec3d(result.mesh.positions[i])) - kRadius;
    squares += error * error;
    in_sigmas += std::pow(error / attributes.sigma[i], 2);
    count += 1;
  }
  EXPECT_NEAR(std::sqrt(in_sigmas / count), 1, 0.25);
  // A single pixel's is 1.2 mm; about eight views see each place.
  EXPECT_LT(std::sqrt(squares / count), 1.2e-3 / std::sqrt(8));
}

/// Edges of a box: their voxels are seen empty past one side and measured on the other. Where only
/// views that see a side at less than ten degrees tell of a corner, a small hole may stay.
TEST(FuseVolume, FollowsTheEdgesOfABox) {
  const FusedVolume result = fused(views_of(make_box({0.2, 0.25, 0.15}, 8), 24, 1));
  expect_manifold(result.mesh);
  const Topology t = topology(result.mesh);
  EXPECT_LT(static_cast<double>(t.boundary_edges), 0.002 * static_cast<double>(t.edges));
  double nearest = 1;  // to a corner, which nothing but the edges leads to
  for (const Vec3f& p : result.mesh.positions) {
    nearest = std::min(nearest, norm(Vec3d(p) - Vec3d{0.1, 0.125, 0.075}));
  }
  EXPECT_LT(nearest, kVoxel);
}

TEST(FuseVolume, GivesTheSameBytesForEveryNumberOfThreadsAndOrderOfFrames) {
  std::vector<DepthFrame> frames(sphere_views().begin(), sphere_views().begin() + 8);
  Context context;
  context.threads = 1;
  const TriangleMesh alone = fused(frames, {}, context).mesh;
  for (const int threads : {2, 3, 8}) {
    context.threads = threads;
    EXPECT_TRUE(fused(frames, {}, context).mesh == alone) << threads << " threads";
  }
  std::reverse(frames.begin(), frames.end());
  std::swap(frames[1], frames[5]);
  EXPECT_TRUE(fused(frames, {}, context).mesh == alone);
}

/// A plate at 1 m hides a part of a wall at 1.5 m.
DepthFrame scene(bool with_plate) {
  DepthFrame frame = test::empty_frame();
  const auto wall = test::plane({0, 0, 1}, 1.5);
  test::fill(frame, [&](const Vec3d& ray) {
    return with_plate && std::abs(ray.x) < 0.15 && std::abs(ray.y) < 0.15 ? 1.0 : wall(ray);
  });
  return frame;
}

std::size_t vertices_nearer_than(const TriangleMesh& mesh, double z) {
  const auto near = [&](const Vec3f& p) { return p.z < z; };
  return static_cast<std::size_t>(
      std::count_if(mesh.positions.begin(), mesh.positions.end(), near));
}

TEST(FuseVolume, LeavesNoGhostOfWhatMovedAway) {
  const std::vector<DepthFrame> moved{scene(true), scene(false), scene(false)};
  const std::vector<DepthFrame> stayed{scene(true), scene(true), scene(false)};
  EXPECT_EQ(vertices_nearer_than(fused(moved, {0.02}).mesh, 1.25), 0u);
  EXPECT_GT(vertices_nearer_than(fused(stayed, {0.02}).mesh, 1.25), 100u);
}

/// What lies behind the plate was not seen: the wall has a hole there, and nothing joins the two.
TEST(FuseVolume, MakesNothingWhereNothingWasSeen) {
  const std::vector<DepthFrame> frames{scene(true)};
  const FusedVolume result = fused(frames, {0.02});
  expect_manifold(result.mesh);
  EXPECT_GE(topology(result.mesh).components, 2u);
  EXPECT_GE(topology(result.mesh).boundary_loops, 3u);
  for (const Vec3f& p : result.mesh.positions) {
    EXPECT_TRUE(std::abs(p.z - 1) < 0.02 || std::abs(p.z - 1.5) < 0.02) << p.z;
    // The plate's shadow, less two pixels and two voxels at its outline.
    const double shadow = 0.15 * 1.5 - 2 * 1.5 / 146 - 2 * 0.02;
    EXPECT_FALSE(p.z > 1.25 && std::abs(p.x) < shadow && std::abs(p.y) < shadow);
  }
}

TEST(FuseVolume, CountsAVoxelThatTooFewSawAsNotSeen) {
  const std::vector<DepthFrame> frames{scene(true), scene(true), scene(false)};
  const auto result = fused(frames, {0.02, 3, 3, 3});
  EXPECT_EQ(vertices_nearer_than(result.mesh, 1.25), 0u);
  EXPECT_GT(result.mesh.positions.size(), 500u);
}

/// The band is 2 * 3 voxels deep and has a margin of 1.5 on every side: with the blocks that it
/// cuts at its ends at most three layers, and of the wall's blocks a third more for its outline.
TEST(FuseVolume, KeepsBlocksWhereASurfaceIsAlone) {
  const std::vector<DepthFrame> once{scene(false)};
  const std::vector<DepthFrame> often(12, scene(false));
  const auto report = fused(once, {0.02}).report;
  const double blocks = 1.6 / 146 / (8 * 0.02);  // a pixel's
  EXPECT_LT(static_cast<double>(report.blocks), 3 * (160 * blocks + 2.5) * (120 * blocks + 2.5));
  EXPECT_EQ(fused(often, {0.02}).report.blocks, report.blocks);
}

TEST(FuseVolume, RefusesWhatCannotBe) {
  const auto code_of = [](std::span<const DepthFrame> frames, const VolumeParams& params) {
    const auto result = fuse_volume(FramesInMemory(frames), params);
    return result ? std::string() : std::string(to_string(result.error().code));
  };
  std::vector<DepthFrame> frames{scene(false), scene(false)};
  EXPECT_EQ(code_of({}, {}), "invalid_argument");
  EXPECT_EQ(code_of(frames, {-1}), "invalid_argument");
  EXPECT_EQ(code_of(frames, {1e-9}), "invalid_argument");    // too far for such voxels
  EXPECT_EQ(code_of(frames, {0.0005}), "invalid_argument");  // too many blocks
  frames[1].depth[5] = -1;
  EXPECT_EQ(code_of(frames, {0.02}), "bad_geometry");
  frames[1].depth.assign(frames[1].depth.size(), 0);
  frames[0] = frames[1];
  EXPECT_EQ(code_of(frames, {}), "bad_geometry");
  frames[1].depth.pop_back();
  EXPECT_EQ(code_of(frames, {}), "bad_geometry");
}

TEST(FuseVolume, StopsWhereItIsCancelled) {
  const std::vector<DepthFrame> frames{scene(false), scene(true)};
  for (const double fraction : {0.05, 0.3, 0.6, 0.95}) {
    test::CancelAt cancel(fraction);
    const auto result = fuse_volume(FramesInMemory(frames), {0.02}, cancel.context());
    ASSERT_FALSE(result) << fraction;
    EXPECT_EQ(result.error().code, ErrorCode::cancelled);
  }
}

}  // namespace
}  // namespace burnish
