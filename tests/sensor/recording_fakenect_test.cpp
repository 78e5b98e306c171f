#include <cmath>

#include "burnish/sensor/raw_disparity.h"
#include "sensor/recordings.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;
using test::expect_refused;
using test::TemporaryFolder;
using test::write_text;

constexpr std::size_t kPixels = 640 * 480;
const std::string kHead = "P5 640 480 65535\n";
const char* const kSecond = "d-1355494975.180000-2000.pgm";

/// Raw values that count up, another begin for each image.
std::vector<std::uint16_t> some_raw(int image) {
  std::vector<std::uint16_t> raw(kPixels);
  for (std::size_t i = 0; i < kPixels; ++i) {
    raw[i] = static_cast<std::uint16_t>((i + 100 * static_cast<std::size_t>(image)) % 2048);
  }
  return raw;
}

/// As libfreenect's record writes it: two depth images, one colour image, the accelerometer.
void write_dump(const fs::path& folder, bool device = true) {
  write_text(folder / "INDEX.txt",
             "d-1355494975.147000-1000.pgm\nr-1355494975.150000-1100.ppm\n"
             "a-1355494975.160000-1000.dump\nd-1355494975.180000-2000.pgm\n");
  write_text(folder / "d-1355494975.147000-1000.pgm", kHead + test::raw_depths(some_raw(0)));
  write_text(folder / kSecond, kHead + test::raw_depths(some_raw(1)));
  write_text(folder / "r-1355494975.150000-1100.ppm",
             "P6 640 480 255\n" + std::string(3 * kPixels, 'g'));
  write_text(folder / "a-1355494975.160000-1000.dump", "twelve bytes");
  if (!device) return;
  write_text(folder / "device.json",
             R"({"const_shift": 201, "reg_info": {"zero_plane_info": {"dcmos_emitter_distance": 7.6,
                 "reference_distance": 120, "reference_pixel_size": 0.1}}})");
}

TEST(ImportFakenect, MakesDepthOfDisparityByTheDevicesGeometry) {
  const TemporaryFolder folder;
  write_dump(folder / "in");
  const auto report = import_recording(folder / "in", folder / "out");
  ASSERT_TRUE(report) << report.error().text();
  EXPECT_EQ(report->frames, 2u);
  EXPECT_EQ(report->color_images, 1u);
  EXPECT_EQ(report->notes,
            (std::vector<std::string>{"1 of 2 depth images have no colour image within 0.02 s",
                                      "no frame has a pose"}));
  const auto frames = open_frames({folder / "out"});
  ASSERT_TRUE(frames) << frames.error().text();
  EXPECT_EQ(frames->sensor().name, "kinect_v1");
  EXPECT_EQ(frames->camera(), (Camera{640, 480, 600, 600, 320, 240}));
  EXPECT_EQ(frames->files()[1].time, 1355494975.18);
  const ZeroPlane plane{7.6, 120, 0.1, 201};
  const auto raw = some_raw(1);
  const auto depths = test::imported_depths(folder / "out", 1);
  for (std::size_t i = 0; i < 2048; ++i) {
    const double depth = depth_of_disparity(raw[i], plane);
    ASSERT_LE(std::abs(depths[i] / 5000.0 - depth), 0.0001 + 1e-12) << raw[i];
  }
}

TEST(ImportFakenect, FallsBackOnLibfreenectsGeometryAndSaysSo) {
  const TemporaryFolder folder;
  write_dump(folder / "in", false);
  const auto report = import_recording(folder / "in", folder / "out", {.frames = 1});
  ASSERT_TRUE(report) << report.error().text();
  EXPECT_NE(report->notes[0].find("no device.json"), std::string::npos);
  EXPECT_NEAR(open_frames({folder / "out"})->camera().fx, 575.8157, 1e-4);
}

/// Triangulation: 1 / z falls linearly with disparity, by one step of 1 / (f b) with f b in pixels
/// of a quarter; the reference plane lies where the disparity is the constant shift.
TEST(RawDisparity, IsThatOfACameraAndAProjector) {
  const ZeroPlane plane;
  const double reference = 4 * (plane.constant_shift + 0.375);
  const double step = plane.reference_pixel_size / 4 / (plane.emitter_distance * 1.2);
  for (std::uint16_t raw = 0; raw < 1050; ++raw) {
    const double z = depth_of_disparity(raw, plane);
    ASSERT_NEAR(1 / z, 1 / 1.2 - (raw - reference) * step, 1e-12) << raw;
  }
  EXPECT_EQ(depth_of_disparity(2047, plane), 0);
  EXPECT_EQ(depth_of_disparity(1080, plane), 0);  // 37 m
  EXPECT_EQ(depth_of_disparity(1200, plane), 0);  // behind the camera
  // 0.2 mm keep any two disparities apart.
  EXPECT_GT(depth_of_disparity(1, plane) - depth_of_disparity(0, plane), 0.0002);
}

TEST(ImportFakenect, RefusesWhatIsDamagedWithThePlace) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& file, const std::string& bytes,
                           const std::string& place, const std::string& reason) {
    write_dump(folder / "in");
    write_text(folder / "in" / file, bytes);
    expect_refused(folder / "in", ErrorCode::bad_file, place, reason);
  };
  const std::string sound = kHead + test::raw_depths(some_raw(1));
  refused(kSecond, "", kSecond, "a line 'P5 640 480 65535'");
  refused(kSecond, sound.substr(0, sound.size() - 2), kSecond, "and then 614400 bytes");
  refused(kSecond, "P5 64000 48000 65535\n", kSecond, "a line 'P5 640 480 65535'");
  std::string high = sound;
  high[kHead.size() + 21] = char(0x08);
  refused(kSecond, high, kSecond, "pixel 10 has the raw value 2158, 11 bits are expected");
  refused("r-1355494975.150000-1100.ppm", "P6 640 480 255\nfew", "1100.ppm", "3 bytes of pixels");
  refused("INDEX.txt", "", "INDEX.txt, line 1", "names no depth image");
  refused("INDEX.txt", "d-1-1.pgm\nd-x-1.pgm\n", "INDEX.txt, line 2", "'d-x-1.pgm' is not");
  refused("INDEX.txt", "d-1.0-/../../secret.pgm\n", "INDEX.txt, line 1", "is not");
  refused("INDEX.txt", "d\n", "INDEX.txt, line 1", "is not");
  refused("device.json", "{\"const_shift\":", "device.json", "no JSON");
  refused("device.json", "{\"const_shift\": 200}", "device.json", "are expected to hold numbers");
  write_dump(folder / "in");
  fs::remove(folder / "in" / "device.json");
  fs::remove(folder / "in" / kSecond);
  expect_refused(folder / "in", ErrorCode::not_found, kSecond, "cannot be read");
}

}  // namespace
}  // namespace burnish
