#include "burnish/sensor/pose_list.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "burnish/io/atomic_writer.h"
#include "burnish/sensor/camera_file.h"
#include "burnish/sensor/presets.h"
#include "support/test_data.h"

namespace burnish {
namespace {

/// A text file for one test.
class TextFile {
 public:
  explicit TextFile(std::string_view text) { EXPECT_TRUE(write_file(path(), text)); }
  std::filesystem::path path() const { return folder_ / "file.txt"; }

 private:
  test::TemporaryFolder folder_;
};

TEST(PoseList, ReadsPositionsAndQuaternions) {
  // A quarter turn around z, with CRLF line ends, a comment and an empty line.
  const TextFile file("# poses\r\n1 2 3 0 0 0.70710678 0.70710678\r\n\r\n0 0 0 0 0 0 1");
  const auto list = read_pose_list(file.path());
  ASSERT_TRUE(list) << list.error().text();
  ASSERT_EQ(list->poses.size(), 2u);
  EXPECT_TRUE(list->times.empty());
  const Vec3d moved = list->poses[0]({1, 0, 0});
  EXPECT_LT(norm(moved - Vec3d{1, 3, 3}), 1e-15);
  EXPECT_EQ(list->poses[1], RigidTransform{});
}

TEST(PoseList, ReadsTumAndRedwood) {
  const TextFile tum("1305031098.6659 1.3563 0.6305 1.6380 0 0 0 1\n");
  const auto timed = read_pose_list(tum.path());
  ASSERT_TRUE(timed) << timed.error().text();
  EXPECT_EQ(timed->times, std::vector<double>{1305031098.6659});
  EXPECT_EQ(timed->poses[0].translation, (Vec3d{1.3563, 0.6305, 1.6380}));

  const TextFile redwood(
      "0 0 1\n1 0 0 5\n0 1 0 6\n0 0 1 7\n0 0 0 1\n1 1 2\n0 -1 0 0\n1 0 0 0\n0 0 1 0\n0 0 0 1\n");
  const auto blocks = read_pose_list(redwood.path());
  ASSERT_TRUE(blocks) << blocks.error().text();
  ASSERT_EQ(blocks->poses.size(), 2u);
  EXPECT_EQ(blocks->poses[0].translation, (Vec3d{5, 6, 7}));
  EXPECT_EQ(blocks->poses[1]({1, 0, 0}), (Vec3d{0, 1, 0}));
}

TEST(PoseList, SaysWhichPosesNobodyKnowsAndReadsWhatItWrites) {
  const RigidTransform there = rigid_from_quaternion(0.1, -0.2, 0.3, 0.9, {1, -2.5, 1. / 3});
  const std::vector<std::optional<RigidTransform>> poses{std::nullopt, there, std::nullopt};
  const TextFile file(pose_list_text(poses, std::vector<std::string>{"too dark", "", ""}));
  const auto list = read_pose_list(file.path());
  ASSERT_TRUE(list) << list.error().text();
  EXPECT_EQ(list->unknown, (std::vector<bool>{true, false, true}));
  EXPECT_EQ(list->poses[1].translation, there.translation);
  EXPECT_LT(norm(list->poses[1]({1, 2, 3}) - there({1, 2, 3})), 1e-14);
  EXPECT_FALSE(read_pose_list(TextFile("-\n-\n").path()));
  EXPECT_FALSE(read_pose_list(TextFile("-\n0 0 0 0 0 0 0 1\n").path()));
}

struct Bad {
  const char* text;
  int line;
  const char* reason;
};

TEST(PoseList, WhatIsWrongIsNamedWithItsLine) {
  for (const Bad& bad : {
           Bad{"0 0 0 0 0 0 1\n0 0 0 0 0 1\n", 2, "6 numbers, 7 as on the first line expected"},
           Bad{"0 0 0 0 0 0 1\n0 0 0 0 0 0 1.5\n", 2, "has length 1.5, not 1"},
           Bad{"0 0 0 0 0 0 0\n", 1, "has length 0, not 1"},
           Bad{"0 0 zero 0 0 0 1\n", 1, "'zero' is not a number"},
           Bad{"0 0 nan 0 0 0 1\n", 1, "nan is not finite"},
           Bad{"1 2 3 4 5\n", 1, "5 numbers"},
           Bad{"0 0 1\n1 0 0 0\n0 1 0 0\n0 0 2 0\n0 0 0 1\n", 5, "no rotation"},
           Bad{"0 0 1\n1 0 0 0\n0 1 0 0\n0 0 -1 0\n0 0 0 1\n", 5, "no rotation"},
           Bad{"0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 1 1\n", 5, "not 0 0 0 1"},
           Bad{"0 0 1\n1e200 0 0 0\n0 1e200 0 0\n0 0 1e200 0\n0 0 0 1\n", 5, "no rotation"},
           Bad{"0 0 1\n1 0 0 0\n0 1 0\n", 3, "3 numbers, a matrix row of 4 expected"},
           Bad{"0 0 1\n1 0 0 0\n0 1 0 0\n", 4, "ends within"},
       }) {
    const TextFile file(bad.text);
    const auto list = read_pose_list(file.path());
    ASSERT_FALSE(list) << bad.text;
    EXPECT_EQ(list.error().where, file.path().string() + ", line " + std::to_string(bad.line))
        << list.error().text();
    EXPECT_NE(list.error().message.find(bad.reason), std::string::npos) << list.error().message;
  }
  EXPECT_FALSE(read_pose_list(TextFile("# nothing\n").path()));
}

TEST(PoseList, EveryTruncationIsAListOrAnError) {
  const std::string text = "0 0 1\n1 0 0 5\n0 1 0 6\n0 0 1 7\n0 0 0 1\n";
  for (std::size_t length = 0; length < text.size(); ++length) {
    const TextFile file(text.substr(0, length));
    const auto list = read_pose_list(file.path());
    EXPECT_TRUE(!list || list->poses.size() == 1) << length;
    EXPECT_EQ(bool(list), length + 1 == text.size()) << length;
  }
}

TEST(PoseList, AMatrixComesBackAsItWasWritten) {
  const RigidTransform pose = look_at({1.1, 2.2, 3.3}, {0.1, 0, 0}, {0, 0, 1});
  const TextFile file(pose_matrix_text(pose));
  const auto read = read_pose_matrix(file.path());
  ASSERT_TRUE(read) << read.error().text();
  EXPECT_EQ(*read, pose);
  const TextFile longer(pose_matrix_text(pose) + "1 2 3 4\n");
  EXPECT_FALSE(read_pose_matrix(longer.path()));
}

TEST(CameraFile, ComesBackAsItWasWritten) {
  CameraFile camera{Camera{640, 480, 585.1, 584.9, 319.7, 240.3}, 0.0002, "kinect_v1"};
  const auto read = read_camera_file(TextFile(camera_file_text(camera)).path());
  ASSERT_TRUE(read) << read.error().text();
  EXPECT_EQ(read->camera, camera.camera);
  EXPECT_EQ(read->depth_scale, camera.depth_scale);
  EXPECT_EQ(read->sensor, camera.sensor);

  const auto matrix = read_camera_file(TextFile(intrinsics_text(*camera.camera)).path());
  ASSERT_TRUE(matrix) << matrix.error().text();
  EXPECT_EQ(matrix->camera, (Camera{0, 0, 585.1, 584.9, 319.7, 240.3}));
}

TEST(CameraFile, WhatIsWrongIsNamedWithItsLine) {
  for (const Bad& bad :
       {Bad{"585 0 320\n0 585 240\n", 3, "too early"},
        Bad{"585 1 320\n0 585 240\n0 0 1\n", 4, "matrix is not"},
        Bad{"-585 0 320\n0 585 240\n0 0 1\n", 4, "matrix is not"},
        Bad{"585 0\n", 1, "three numbers"}, Bad{"fx 585\nfocal 3\n", 2, "'focal'"},
        Bad{"fx 585\nfy 0x1\n", 2, "'fy'"}, Bad{"depth_scale -1\n", 1, "'depth_scale'"},
        Bad{"fx 585\n", 2, "not all there"}, Bad{"", 1, "empty"}}) {
    const TextFile file(bad.text);
    const auto read = read_camera_file(file.path());
    ASSERT_FALSE(read) << bad.text;
    EXPECT_EQ(read.error().where, file.path().string() + ", line " + std::to_string(bad.line))
        << read.error().text();
    EXPECT_NE(read.error().message.find(bad.reason), std::string::npos) << read.error().message;
  }
}

TEST(CameraFile, FourNumbersAreACamera) {
  EXPECT_EQ(parse_camera("585,586,320,240.5").value(), (Camera{0, 0, 585, 586, 320, 240.5}));
  for (const char* text :
       {"", "585", "585,585,320", "585,585,320,240,1", "0,585,320,240", "a,b,c,d"}) {
    EXPECT_FALSE(parse_camera(text)) << text;
  }
}

TEST(Sensors, AreFoundByNameAndSound) {
  for (const Sensor& sensor : sensors()) {
    EXPECT_EQ(find_sensor(sensor.name).value(), sensor);
    EXPECT_TRUE(check(sensor.camera)) << sensor.name;
  }
  EXPECT_NE(find_sensor("kinect").error().message.find("kinect_v1, primesense"), std::string::npos);
}

TEST(Sensors, KinectV1SeesWhatTheFirstPaperStates) {
  const Sensor kinect = find_sensor("kinect_v1").value();
  const double degrees = 180 / std::numbers::pi;
  EXPECT_NEAR(2 * std::atan(320 / kinect.camera.fx) * degrees, 57, 1e-12);
  EXPECT_NEAR(2 * std::atan(240 / kinect.camera.fy) * degrees, 47, 1e-12);
  // Nguyen, Izadi and Lovell 2012 at 2 m: 1.2 + 1.9 * 1.6^2 = 6.064 mm.
  EXPECT_NEAR(kinect.noise.axial(2, 0.5), 0.006064, 1e-15);
  EXPECT_NEAR(kinect.noise.lateral(2, 0, 600), 0.8 * 2 / 600, 1e-15);
  // Khoshelham and Elberink 2012: 7 cm steps at 5 m.
  EXPECT_NEAR(kinect.disparity_step * 25, 0.07125, 1e-12);
}

}  // namespace
}  // namespace burnish
