#include "burnish/sensor/turntable.h"

#include <gtest/gtest.h>

#include <cmath>

#include "burnish/io/atomic_writer.h"
#include "burnish/io/file.h"
#include "burnish/io/geometry_file.h"
#include "burnish/sensor/frame_sequence.h"
#include "burnish/shapes/shapes.h"
#include "support/test_data.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

/// A camera of few pixels, so that tests are quick.
Sensor small_sensor(const char* name = "kinect_v1") {
  Sensor sensor = find_sensor(name).value();
  Camera& c = sensor.camera;
  c = {80, 60, c.fx / 8, c.fy / 8, 39.5, 29.5};
  return sensor;
}

std::vector<std::string> files_below(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) names.push_back(fs::relative(entry.path(), folder).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string all_bytes(const fs::path& folder) {
  std::string all;
  for (const std::string& name : files_below(folder)) {
    all += name;
    all += read_file(folder / name)->text();
  }
  return all;
}

TEST(Turntable, WithoutNoiseEveryPixelIsOnTheModel) {
  const test::TemporaryFolder folder;
  const TriangleMesh model = make_box({0.3, 0.2, 0.1});
  TurntableParams params{.views = 4, .noise = 0};
  const auto done = simulate_turntable(model, small_sensor(), params, folder.path());
  ASSERT_TRUE(done) << done.error().text();
  const auto frames = open_frames({folder.path()});
  ASSERT_TRUE(frames) << frames.error().text();
  ASSERT_EQ(frames->size(), 4u);
  EXPECT_TRUE(frames->has_poses());
  EXPECT_TRUE(frames->notes().empty());
  EXPECT_EQ(frames->sensor().name, "kinect_v1");
  std::size_t measured = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto frame = frames->read(i);
    ASSERT_TRUE(frame) << frame.error().text();
    for (std::uint32_t v = 0; v < 60; ++v) {
      for (std::uint32_t u = 0; u < 80; ++u) {
        const double z = frame->depth[v * 80 + u];
        if (z == 0) continue;
        ++measured;
        const Vec3d p = frame->T_world_camera(frame->camera.unproject(u, v, z));
        // Distance to the surface of the box: the largest of the three slab distances.
        const double outside =
            std::max({std::abs(p.x) - 0.15, std::abs(p.y) - 0.1, std::abs(p.z) - 0.05});
        // Depth of about 0.6 m and the box's corners are rounded to float: 2^-24 of each.
        EXPECT_NEAR(outside, 0, 1e-7);
      }
    }
  }
  EXPECT_EQ(measured, done->measured_pixels);
  EXPECT_GT(measured, 4u * 80 * 60 / 20);
}

TEST(Turntable, WritesTheTruthBesideTheFrames) {
  const test::TemporaryFolder folder;
  const TurntableParams params{.views = 3, .size = 0.5};
  const auto done = simulate_turntable(make_box({2, 1, 1}), small_sensor(), params, folder.path());
  ASSERT_TRUE(done) << done.error().text();
  EXPECT_EQ(done->scale, 0.25);
  EXPECT_EQ(
      files_below(folder.path()),
      (std::vector<std::string>{
          "camera-intrinsics.txt", "camera.txt", "frame-000000.depth.png", "frame-000000.pose.txt",
          "frame-000001.depth.png", "frame-000001.pose.txt", "frame-000002.depth.png",
          "frame-000002.pose.txt", "simulation.json", "truth/model.ply", "truth/poses.txt"}));
  const auto truth = read_mesh(folder / "truth/model.ply");
  ASSERT_TRUE(truth) << truth.error().text();
  EXPECT_EQ(truth->positions, make_box({0.5, 0.25, 0.25}).positions);
  // The list of true poses is the poses beside the frames.
  FrameOptions options;
  options.poses = folder / "truth/poses.txt";
  const auto listed = open_frames({folder.path()}, options);
  const auto beside = open_frames({folder.path()});
  ASSERT_TRUE(listed && beside);
  for (std::size_t i = 0; i < 3; ++i) {
    const RigidTransform apart =
        listed->files()[i].T_world_camera->inverse() * *beside->files()[i].T_world_camera;
    EXPECT_LT(norm(apart.translation), 1e-14);
    EXPECT_LT(norm(apart.rows[0] - Vec3d{1, 0, 0}), 1e-14);
  }
}

TEST(Turntable, GivesTheSameBytesForAnyNumberOfThreads) {
  const TurntableParams params{.views = 2};
  std::string expected;
  for (const int threads : {1, 2, 3, 8}) {
    const test::TemporaryFolder folder;
    Context context;
    context.threads = threads;
    ASSERT_TRUE(simulate_turntable(make_shape("torus").value(), small_sensor(), params,
                                   folder.path(), context));
    const std::string bytes = all_bytes(folder.path());
    if (threads == 1) expected = bytes;
    EXPECT_EQ(bytes, expected) << threads;
  }
}

TEST(Turntable, AnotherSeedIsAnotherNoise) {
  const test::TemporaryFolder a, b;
  ASSERT_TRUE(
      simulate_turntable(make_sphere(0.1), small_sensor(), {.views = 1, .seed = 1}, a.path()));
  ASSERT_TRUE(
      simulate_turntable(make_sphere(0.1), small_sensor(), {.views = 1, .seed = 2}, b.path()));
  EXPECT_NE(read_file(a / "frame-000000.depth.png")->text(),
            read_file(b / "frame-000000.depth.png")->text());
}

TEST(Turntable, AnEarlierSimulationIsReplacedAnythingElseIsKept) {
  const test::TemporaryFolder folder;
  const TriangleMesh model = make_sphere(0.1);
  ASSERT_TRUE(simulate_turntable(model, small_sensor(), {.views = 3}, folder / "new/scan"));
  ASSERT_TRUE(write_file(folder / "new/scan/notes.txt", "mine"));
  ASSERT_TRUE(
      simulate_turntable(model, small_sensor(), {.views = 2, .noise = 0}, folder / "new/scan"));
  EXPECT_EQ(open_frames({folder / "new/scan"})->size(), 2u);
  EXPECT_EQ(read_file(folder / "new/scan/notes.txt")->text(), "mine");

  ASSERT_TRUE(write_file(folder / "thesis.txt", "dear"));
  const auto refused = simulate_turntable(model, small_sensor(), {.views = 1}, folder.path());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::invalid_argument);
  EXPECT_EQ(refused.error().where, folder.path().string());
  const auto file = simulate_turntable(model, small_sensor(), {.views = 1}, folder / "thesis.txt");
  EXPECT_EQ(file.error().code, ErrorCode::invalid_argument);
  EXPECT_FALSE(fs::exists(folder / ".burnish-part"));
}

/// Asks to stop once the work is half done.
class StopHalfway : public ProgressSink {
 public:
  void on_progress(double fraction) override {
    EXPECT_GE(fraction, last_);
    EXPECT_LE(fraction, 1);
    last_ = fraction;
    if (fraction > 0.5) stop.request_stop();
  }
  std::stop_source stop;

 private:
  double last_ = 0;
};

TEST(Turntable, CancellationLeavesTheFolderAsItWas) {
  const test::TemporaryFolder folder;
  const TriangleMesh model = make_sphere(0.1);
  const fs::path fresh = folder / "fresh", earlier = folder / "earlier";
  ASSERT_TRUE(simulate_turntable(model, small_sensor(), {.views = 2}, earlier));
  const std::string before = all_bytes(earlier);
  for (const fs::path& target : {fresh, earlier}) {
    StopHalfway sink;
    Context context;
    context.sink = &sink;
    context.stop = sink.stop.get_token();
    const auto done = simulate_turntable(model, small_sensor(), {.views = 5}, target, context);
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().code, ErrorCode::cancelled);
  }
  EXPECT_FALSE(fs::exists(fresh));
  EXPECT_EQ(all_bytes(earlier), before);
}

TEST(Turntable, WhatTheSensorCannotMeasureIsRefused) {
  const test::TemporaryFolder folder;
  const auto large = simulate_turntable(make_sphere(3), small_sensor(), {}, folder / "a");
  ASSERT_FALSE(large);
  EXPECT_NE(large.error().message.find("give another size or distance"), std::string::npos);
  EXPECT_FALSE(simulate_turntable(make_sphere(0.1), small_sensor(), {.distance = 5}, folder / "b"));
  EXPECT_FALSE(simulate_turntable(TriangleMesh{}, small_sensor(), {}, folder / "c"));
  EXPECT_FALSE(simulate_turntable(make_sphere(0.1), small_sensor(), {.views = 0}, folder / "d"));
  EXPECT_TRUE(files_below(folder.path()).empty());
}

}  // namespace
}  // namespace burnish
