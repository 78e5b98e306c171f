#include "burnish/pipeline/registered_frames.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "burnish/io/depth_image.h"
#include "burnish/pipeline/scans.h"
#include "support/registration_pairs.h"
#include "support/test_data.h"

namespace burnish {
namespace {

using namespace test::pairs;

/// Frames of a figure on a turntable, as floats and without poses; frame 3 is of nothing near.
std::vector<std::filesystem::path> write_shots(const test::TemporaryFolder& folder) {
  Random random(3, 0);
  const TriangleMesh figure = random_figure(random);
  TriangleMesh other;
  append(other, make_box({0.2, 0.2, 0.2}), {.translation = {0, 0.25, 0}});
  const Sensor sensor = kinect(4);
  const RigidTransform camera = look_at({0.55, 0, 0.35}, {0, 0, 0}, {0, 0, 1});
  std::vector<std::filesystem::path> files;
  for (int i = 0; i < 6; ++i) {
    const DepthFrame frame = photograph(i == 3 ? other : figure, sensor,
                                        turn_about({0, 0, 1}, 5 * kDegree * i) * camera, i);
    files.push_back(folder / ("depth" + std::to_string(i) + ".tiff"));
    EXPECT_TRUE(
        write_depth_tiff(files.back(), frame.camera.width, frame.camera.height, frame.depth));
  }
  return files;
}

FrameOptions small_kinect() {
  FrameOptions options;
  options.camera = kinect(4).camera;
  options.sensor = "kinect_v1";
  return options;
}

TEST(RegisteredFrames, SaysWhichFrameIsLeftOutAndWhy) {
  const test::TemporaryFolder folder;
  const auto frames = open_frames(write_shots(folder), small_kinect());
  ASSERT_TRUE(frames) << frames.error().text();
  Record record;
  const auto found = register_frames(*frames, {}, record);
  ASSERT_TRUE(found) << found.error().text();
  EXPECT_EQ(found->poses.placed(), 5u);
  EXPECT_NE(found->reasons[3].find("with frame"), std::string::npos) << found->reasons[3];
  ASSERT_EQ(record.notes.size(), 1u);
  EXPECT_NE(record.notes.front().find("depth3.tiff"), std::string::npos) << record.notes.front();
  ASSERT_EQ(record.steps.size(), 1u);
  EXPECT_EQ(record.steps.front().verb, "register");
  const auto json = nlohmann::json::parse(registration_json(*frames, *found));
  EXPECT_EQ(json["frames"].size(), 6u);
  EXPECT_FALSE(json["frames"][3]["placed"].get<bool>());
  EXPECT_EQ(json["pairs"].size(), found->poses.pairs.size());
}

TEST(RegisteredFrames, ScansWithoutPosesAreRegistered) {
  const test::TemporaryFolder folder;
  const auto scans = open_scans({write_shots(folder), small_kinect()});
  ASSERT_TRUE(scans) << scans.error().text();
  EXPECT_EQ((*scans)->size(), 5u);
  ASSERT_EQ((*scans)->steps().size(), 1u);
  EXPECT_EQ((*scans)->steps().front().method, "sequence");
}

}  // namespace
}  // namespace burnish
