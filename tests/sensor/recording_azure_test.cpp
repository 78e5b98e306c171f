#include "burnish/sensor/recording_azure.h"

#include <cmath>
#include <cstdlib>

#include "burnish/sensor/lens.h"
#include "sensor/recordings.h"
#include "support/matroska_file.h"
#include "support/recording_promises.h"
#include "support/subprocess.h"

namespace burnish {
namespace {

using test::block;
using test::cluster;
using test::expect_refused;
using test::TemporaryFolder;
using test::track_entry;
using test::write_text;

constexpr std::uint32_t kWidth = 320, kHeight = 288;
const std::string kJpeg = "\xff\xd8\xff some JPEG";

std::string big_endian_depths(int image) {
  std::string bytes;
  for (const std::uint16_t depth : test::some_depths(kWidth, kHeight, image))
    bytes += test::big_endian(depth, 2);
  return bytes;
}

/// A calibration as devices have it; `k1` of the lens, whose other numbers are 0.
std::string calibration(double k1) {
  return R"({"CalibrationInformation":{"Cameras":[{"Location":"CALIBRATION_CameraLocationPV0"},
    {"Intrinsics":{"ModelParameterCount":14,"ModelParameters":[0.5,0.5,0.4921875,0.49609375,)" +
         std::to_string(k1) +
         R"(,0,0,0,0,0,0,0,0,0]},"Location":"CALIBRATION_CameraLocationD0"}]}})";
}

std::string tracks(std::string_view depth_fourcc = "b16g") {
  return test::element(0x1654AE6B, track_entry(1, "COLOR", "MJPG", 1280, 720) +
                                       track_entry(2, "DEPTH", depth_fourcc, kWidth, kHeight) +
                                       track_entry(3, "IR", "b16g", kWidth, kHeight));
}

std::string clusters() {
  return cluster(2000, block(1, -2, kJpeg) + block(2, 0, big_endian_depths(0)) +
                           block(3, 0, big_endian_depths(7))) +
         cluster(2033, block(2, 0, big_endian_depths(1), true));
}

TEST(ImportAzure, ReadsDepthColourAndTimes) {
  const TemporaryFolder folder;
  write_text(folder / "in", test::matroska_file(test::tag("K4A_DEVICE_SERIAL_NUMBER", "12") +
                                                tracks() + clusters()));
  const auto report = import_recording(folder / "in", folder / "out");
  ASSERT_TRUE(report) << report.error().text();
  EXPECT_EQ(report->frames, 2u);
  EXPECT_EQ(report->color_images, 1u);
  EXPECT_NE(report->notes[0].find("no calibration"), std::string::npos);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(test::imported_depths(folder / "out", i), test::some_depths(kWidth, kHeight, i));
  }
  EXPECT_EQ(test::bytes_of(folder / "out" / "frame-000000.color.jpg"), kJpeg);
  EXPECT_EQ(test::bytes_of(folder / "out" / "rgb.txt"),
            "# s, colour image\n1.998000 frame-000000.color.jpg\n");
  EXPECT_NE(test::bytes_of(folder / "out" / "recording.json").find("SERIAL"), std::string::npos);
  const auto frames =
      open_frames({folder / "out"}, {.poses = {}, .camera = Camera{0, 0, 9, 9, 9, 9}});
  ASSERT_TRUE(frames) << frames.error().text();
  EXPECT_EQ(frames->sensor().name, "azure_kinect");
  EXPECT_EQ(frames->files()[1].time, 2.033);
}

TEST(ImportAzure, TakesTheDepthTrackThatTheTagNames) {
  const TemporaryFolder folder;
  write_text(folder / "in",
             test::matroska_file(tracks() + clusters() + test::tag("K4A_DEPTH_TRACK", "1003")));
  ASSERT_TRUE(import_recording(folder / "in", folder / "out"));
  EXPECT_EQ(test::imported_depths(folder / "out", 0), test::some_depths(kWidth, kHeight, 7));
}

TEST(ImportAzure, AStraightLensLeavesThePixelsAndTheCameraIsThatOfTheMode) {
  const TemporaryFolder folder;
  write_text(folder / "in",
             test::matroska_file(test::attached_file("calibration.json", calibration(0)) +
                                 tracks() + clusters()));
  ASSERT_TRUE(import_recording(folder / "in", folder / "out"));
  EXPECT_EQ(test::imported_depths(folder / "out", 0), test::some_depths(kWidth, kHeight, 0));
  // 320 x 288 are cut at (96, 90) from 512 x 512.
  EXPECT_EQ(open_frames({folder / "out"})->camera(),
            (Camera{kWidth, kHeight, 252, 254, 256 - 96 - 0.5, 256 - 90 - 0.5}));
}

/// A camera that sees its own rays bent sees them where the pinhole does once they are straight.
TEST(Lens, UndistortionTakesEveryRayToItsPinhole) {
  const Camera camera{640, 576, 504, 504, 326, 338};
  const Lens lens{{5.2, 3.4, 0.2, 5.5, 5.1, 1.0}, 6e-5, -5e-5};  // as an Azure Kinect's are
  const auto sources = undistortion(camera, lens);
  std::size_t moved = 0;
  for (std::uint32_t v = 0; v < camera.height; v += 7) {
    for (std::uint32_t u = 0; u < camera.width; u += 7) {
      const std::uint32_t source = sources[v * camera.width + u];
      if (source == camera.width * camera.height) continue;
      const Vec3d bent = lens.bend((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy);
      const double du = source % camera.width - (bent.x * camera.fx + camera.cx);
      const double dv = source / camera.width - (bent.y * camera.fy + camera.cy);
      ASSERT_LE(std::abs(du), 0.5 + 1e-9);
      ASSERT_LE(std::abs(dv), 0.5 + 1e-9);
      moved += source != v * camera.width + u;
    }
  }
  EXPECT_GT(moved, 1000u);
  // Barrel distortion in numbers: x = y = 0.5 by hand.
  EXPECT_NEAR((Lens{{-0.2, 0, 0, 0, 0, 0}, 0.01, 0.02}.bend(0.5, 0.5).x),
              0.5 * (1 - 0.2 * 0.5) + 2 * 0.01 * 0.25 + 0.02 * (0.5 + 0.5), 1e-15);
}

TEST(ImportAzure, RefusesWhatIsDamagedWithThePlace) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& bytes, ErrorCode code, const std::string& reason) {
    write_text(folder / "in", bytes);
    expect_refused(folder / "in", code, "in, ", reason);
  };
  const std::string whole = test::matroska_file(tracks() + clusters());
  refused(whole.substr(0, whole.size() - 1), ErrorCode::bad_file, "an element claims");
  refused(whole.substr(0, 3) + "\xA3", ErrorCode::bad_file, "ends within the head");
  refused(whole + std::string(1, '\0'), ErrorCode::bad_file, "no Matroska element begins here");
  refused(test::matroska_file(clusters()), ErrorCode::unsupported, "no track is called DEPTH");
  refused(test::matroska_file(tracks()), ErrorCode::bad_file, "no depth image");
  refused(test::matroska_file(tracks("H264") + clusters()), ErrorCode::unsupported, "H264, plain");
  refused(test::matroska_file(tracks() + cluster(0, block(2, 0, "few"))), ErrorCode::bad_file,
          "frame 0 has 3 bytes, 320 x 288 x 2 are expected");
  refused(test::matroska_file(tracks() + cluster(0, block(2, 0, "few", false, 2))),
          ErrorCode::unsupported, "several images");
  refused(test::matroska_file(tracks() + cluster(0, test::element(0xA3, "\x82"))),
          ErrorCode::bad_file, "ends within its head");
  refused(test::matroska_file(tracks() + cluster(~std::uint64_t{0}, block(2, 0, "few"))),
          ErrorCode::bad_file, "out of all bounds");
  refused(test::matroska_file(
              tracks() + cluster(0, block(1, 0, "no JPEG") + block(2, 0, big_endian_depths(0)))),
          ErrorCode::bad_file, "the colour image of frame 0 is no JPEG");
  const std::string huge =
      test::element(0x1654AE6B, track_entry(2, "DEPTH", "b16g", 1u << 31, 1u << 31));
  refused(test::matroska_file(huge + clusters()), ErrorCode::bad_file, "2147483648 x 2147483648");
  for (const char* text : {"", "{", "[]", R"({"CalibrationInformation":{"Cameras":7}})",
                           R"({"CalibrationInformation":{"Cameras":[]}})",
                           R"({"CalibrationInformation":{"Cameras":[{"Location":
                              "CALIBRATION_CameraLocationD0"}]}})"}) {
    refused(
        test::matroska_file(test::attached_file("calibration.json", text) + tracks() + clusters()),
        ErrorCode::bad_file, "xpected");
  }
}

TEST(ImportAzure, KeepsItsPromisesForEveryTruncation) {
  const std::string whole = test::matroska_file(
      test::attached_file("calibration.json", calibration(0.1)) + tracks() + clusters());
  for (std::size_t size = 0; size < whole.size(); size += size < 1500 ? 1 : 9973)
    test::expect_azure_promises_kept(std::string_view(whole).substr(0, size));
}

/// What fuzzing begins with, and what it found.
TEST(ImportAzure, KeepsItsPromisesForTheSeeds) {
  const auto seeds = test::source_folder() / "fuzz" / "seeds" / "azure";
  for (const auto& entry : std::filesystem::directory_iterator(seeds)) {
    test::expect_azure_promises_kept(test::bytes_of(entry.path()));
  }
  EXPECT_TRUE(open_azure(test::bytes_of(seeds / "two_images.mkv"), "input", {}));
}

/// What ffmpeg makes of the same file.
TEST(ImportAzure, AgreesWithFfmpeg) {
  if (std::system("ffmpeg -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "there is no ffmpeg";
  const TemporaryFolder folder;
  write_text(folder / "in.mkv", test::matroska_file(tracks() + clusters()));
  const std::string raw = folder / "raw";
  const auto outcome = test::run_program({"/usr/bin/ffmpeg", "-nostdin", "-v", "error", "-i",
                                          folder / "in.mkv", "-map", "0:1", "-f", "rawvideo",
                                          "-pix_fmt", "gray16le", "-vsync", "0", raw});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(test::bytes_of(raw), test::raw_depths(test::some_depths(kWidth, kHeight, 0)) +
                                     test::raw_depths(test::some_depths(kWidth, kHeight, 1)));
}

}  // namespace
}  // namespace burnish
