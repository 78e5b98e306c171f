// What is done to depth frames on their way to points.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "burnish/io/depth_image.h"
#include "burnish/io/geometry_file.h"
#include "burnish/pipeline/reconstruct.h"
#include "burnish/sensor/virtual_camera.h"
#include "burnish/shapes/shapes.h"
#include "support/test_data.h"

namespace burnish {
namespace {

const Method kMean{"temporal_mean", {}};

Sensor small_sensor() {
  Sensor sensor = find_sensor("primesense").value();
  sensor.camera = {160, 120, 131, 131, 79.5, 59.5};
  return sensor;
}

FrameOptions small_camera() {
  return {.camera = small_sensor().camera, .sensor = "primesense"};
}

/// Frames of a torus from where `poses` are, as floats so that nothing is rounded.
void write_frames(const test::TemporaryFolder& folder, const std::vector<RigidTransform>& poses) {
  const auto camera = VirtualCamera::create(make_shape("torus").value(), small_sensor());
  ASSERT_TRUE(camera);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto frame = camera->capture(poses[i], {.view = i});
    ASSERT_TRUE(frame);
    ASSERT_TRUE(
        write_depth_tiff(folder / ("frame" + std::to_string(i) + ".tiff"), 160, 120, frame->depth));
  }
}

const RigidTransform kHere = look_at({0.5, 0.4, 0.5}, {0, 0, 0}, {0, 0, 1});

std::size_t finite(const PointCloud& cloud) {
  return static_cast<std::size_t>(
      std::count_if(cloud.positions.begin(), cloud.positions.end(), is_finite<float>));
}

TEST(FrameSteps, FramesWithoutPosesAreAveragedAsFromOnePlace) {
  const test::TemporaryFolder folder;
  write_frames(folder, std::vector<RigidTransform>(7, kHere));
  const auto scans =
      open_scans({{folder.path()}, small_camera()}, {.average = kMean, .frames_at_once = 4}, true);
  ASSERT_TRUE(scans) << scans.error().text();
  ASSERT_EQ((*scans)->size(), 2u);
  EXPECT_NE((*scans)->notes().back().find("7 frames without poses"), std::string::npos);
  const auto first = (*scans)->read(0, {}), second = (*scans)->read(1, {});
  ASSERT_TRUE(first && second);
  const auto most = [](const PointCloud& cloud) {
    return *std::max_element(cloud.attributes.observations.begin(),
                             cloud.attributes.observations.end());
  };
  EXPECT_EQ(most(first->cloud), 4u);
  EXPECT_EQ(most(second->cloud), 3u);
  ASSERT_EQ(first->steps.size(), 1u);
  EXPECT_EQ(first->steps[0].verb, "average");
  ASSERT_TRUE(first->raw);
  EXPECT_GT(first->raw->positions.size(), 3 * finite(first->cloud));
}

TEST(FrameSteps, OnlyFramesOfOnePoseThatFollowEachOtherAreAveraged) {
  const test::TemporaryFolder folder;
  write_frames(folder, std::vector<RigidTransform>(5, kHere));
  std::ofstream(folder / "poses.txt") << "0 0 0 0 0 0 1\n0 0 0 0 0 0 1\n1 0 0 0 0 0 1\n"
                                         "0 0 0 0 0 0 1\n0 0 0 0 0 0 1\n";
  const auto scans = open_scans({{folder.path()}, small_camera()}, {.average = kMean});
  ASSERT_TRUE(scans) << scans.error().text();
  EXPECT_EQ((*scans)->size(), 3u);
  EXPECT_EQ(open_scans({{folder.path()}, small_camera()}).value()->size(), 5u);
}

TEST(FrameSteps, AreRecordedAndBringTheSurfaceNearerToTheTruth) {
  const test::TemporaryFolder folder;
  write_frames(folder, std::vector<RigidTransform>(6, kHere));
  std::ofstream poses(folder / "poses.txt");
  for (int i = 0; i < 6; ++i) poses << "0 0 0 0 0 0 1\n";
  poses.close();
  TriangleMesh truth = make_shape("torus").value();
  const RigidTransform T_camera_world = kHere.inverse();
  for (Vec3f& p : truth.positions) p = Vec3f(T_camera_world(Vec3d(p)));
  ASSERT_TRUE(write_mesh(folder / "truth.ply", truth));
  std::vector<double> rms;
  Recipe recipe;
  recipe.smooth.clear();
  const auto run = [&] {
    const auto made = reconstruct(
        {{folder / "frame0.tiff", folder / "frame1.tiff", folder / "frame2.tiff",
          folder / "frame3.tiff", folder / "frame4.tiff", folder / "frame5.tiff"},
         {.poses = folder / "poses.txt", .camera = small_sensor().camera, .sensor = "primesense"}},
        recipe, {.truth = folder / "truth.ply"}, {});
    if (!made) ADD_FAILURE() << made.error().text();
    for (const Fact& fact : made->record.comparisons.at(1).second) {
      if (fact.key == "vertices_rms") rms.push_back(fact.value);
    }
    return made->record;
  };
  recipe.frames.average = kMean;
  recipe.frames.frames_at_once = 6;
  const Record averaged = run();
  recipe.frames.filter = {{"bilateral_depth", {}}};
  const Record filtered = run();
  EXPECT_EQ(averaged.steps[1].verb, "average");
  EXPECT_EQ(filtered.steps[2].verb, "filter");
  EXPECT_EQ(filtered.steps[2].settings.size(), 4u);
  const auto raw_points = [](const Record& record) { return record.comparisons.front().second; };
  for (std::size_t i = 0; i < raw_points(averaged).size(); ++i) {
    EXPECT_EQ(raw_points(averaged)[i].value, raw_points(filtered)[i].value);
  }
  const auto raw_rms = raw_points(averaged).at(1);
  EXPECT_EQ(raw_rms.key, "rms");
  EXPECT_LT(rms.at(1), 0.5 * raw_rms.value);
}

TEST(FrameSteps, AreOfFramesNotOfClouds) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_mesh(folder / "sphere.ply", make_sphere()));
  const auto scans = open_scans({{folder / "sphere.ply"}, {}}, {.average = kMean});
  ASSERT_FALSE(scans);
  EXPECT_EQ(scans.error().code, ErrorCode::invalid_argument);
}

}  // namespace
}  // namespace burnish
