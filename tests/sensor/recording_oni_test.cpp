#include "burnish/sensor/recording_oni.h"

#include <cmath>

#include "burnish/sensor/depth_16z.h"
#include "sensor/recordings.h"
#include "support/oni_file.h"
#include "support/recording_promises.h"

namespace burnish {
namespace {

using test::expect_refused;
using test::oni_data;
using test::oni_file;
using test::oni_node;
using test::oni_number;
using test::oni_property;
using test::TemporaryFolder;
using test::write_text;

constexpr std::uint32_t kWidth = 64, kHeight = 48, kPixels = kWidth * kHeight;
const std::string kJpeg = "\xff\xd8\xff some JPEG";

/// A slope with steps, edges and holes: every kind of code occurs.
std::vector<std::uint16_t> some_scene(int image) {
  std::vector<std::uint16_t> depths;
  for (std::uint32_t i = 0; i < kPixels; ++i) {
    const std::uint32_t x = i % kWidth, y = i / kWidth;
    const std::uint32_t depth = 900 + (y < 12 ? 0 : 3 * x) + (x > 40 ? 50u : 0u) +
                                (y > 30 ? 2000 + 100 * static_cast<std::uint32_t>(image) : 0u);
    depths.push_back(static_cast<std::uint16_t>((x + y) % 23 == 0 ? 0 : depth));
  }
  return depths;
}

std::string depth_node(std::string_view codec = "16zT", std::uint64_t format = 100) {
  return oni_node(1, 2, codec, 2, kWidth, kHeight, format);
}

std::string some_oni() {
  return depth_node() + test::oni_ready(1) + oni_node(2, 3, "JPEG", 1, kWidth, kHeight, 200) +
         test::oni_ready(2) + test::oni_data_begin(2) +
         oni_data(1, 1000, 1, test::packed_16z(some_scene(0), true)) + oni_data(2, 1100, 1, kJpeg) +
         oni_data(1, 34000, 2, test::packed_16z(some_scene(1), true));
}

TEST(Depth16z, GivesBackWhatWasPacked) {
  for (const bool table : {false, true}) {
    for (int image = 0; image < 3; ++image) {
      const auto scene = image < 2 ? some_scene(image) : test::some_depths(kWidth, kHeight, 1);
      const std::string packed = test::packed_16z(scene, table);
      const auto bytes = std::as_bytes(std::span(packed));
      EXPECT_EQ(unpack_16z(bytes, table, scene.size()), scene) << table << image;
      EXPECT_FALSE(unpack_16z(bytes, table, scene.size() - 1));
      EXPECT_FALSE(unpack_16z(bytes, table, scene.size() + 1));
      EXPECT_FALSE(unpack_16z(bytes.first(bytes.size() - 1), table, scene.size()));
    }
  }
  // By hand: 100, then 6 less and 1 more, four times that, 20 more, and 300.
  const unsigned char codes[] = {100, 0, 0xC5, 0xE2, 0xFF, 192 - 20, 0xFF, 1, 44};
  EXPECT_EQ(unpack_16z(std::as_bytes(std::span(codes)), false, 9),
            (std::vector<std::uint16_t>{100, 94, 95, 95, 95, 95, 95, 115, 300}));
  const unsigned char beyond[] = {1, 0, 7, 0, 1, 0};  // a table of one value, and its second
  EXPECT_FALSE(unpack_16z(std::as_bytes(std::span(beyond)), true, 1));
}

TEST(ImportOni, ReadsDepthColourCameraAndTimes) {
  const TemporaryFolder folder;
  write_text(folder / "in", oni_file(some_oni()));
  const auto report = import_recording(folder / "in", folder / "out");
  ASSERT_TRUE(report) << report.error().text();
  EXPECT_EQ(report->frames, 2u);
  EXPECT_EQ(report->color_images, 1u);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(test::imported_depths(folder / "out", i), some_scene(i));
  EXPECT_EQ(test::bytes_of(folder / "out" / "frame-000000.color.jpg"), kJpeg);
  const auto frames = open_frames({folder / "out"});
  ASSERT_TRUE(frames) << frames.error().text();
  EXPECT_EQ(frames->files()[1].time, 0.034);
  // The corner of the image is where the field of view ends.
  const Vec3d corner = frames->camera().unproject(0, 0, 1);
  EXPECT_NEAR(std::atan(-corner.x), 1.0144686707507438 / 2, 1e-12);
  EXPECT_NEAR(std::atan(-corner.y), 0.78980943449644714 / 2, 1e-12);
}

TEST(ImportOni, ReadsPlainDepthTenthsOfMillimetresAndMirrors) {
  const TemporaryFolder folder;
  write_text(folder / "in",
             oni_file(depth_node("NONE", 101) + oni_data(1, 0, 1, test::raw_depths(some_scene(0))) +
                      oni_property(1, "xnMirror", oni_number(std::uint64_t{1}), true) +
                      oni_data(1, 1, 2, test::raw_depths(some_scene(1)))));
  const auto report = import_recording(folder / "in", folder / "out");
  ASSERT_TRUE(report) << report.error().text();
  EXPECT_EQ(test::imported_depths(folder / "out", 0), some_scene(0));
  const auto turned = test::imported_depths(folder / "out", 1);
  const auto scene = some_scene(1);
  for (std::size_t i = 0; i < kPixels; ++i)
    ASSERT_EQ(turned[i], scene[i / kWidth * kWidth + kWidth - 1 - i % kWidth]) << i;
  EXPECT_NE(report->notes[0].find("turned back"), std::string::npos);
  EXPECT_NE(test::bytes_of(folder / "out" / "camera.txt").find("depth_scale 0.0001"),
            std::string::npos);
}

TEST(ImportOni, RefusesWhatIsDamagedWithThePlace) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& bytes, ErrorCode code, const std::string& reason) {
    write_text(folder / "in", bytes);
    expect_refused(folder / "in", code, "in, byte ", reason);
  };
  const std::string whole = oni_file(some_oni());
  refused("NI10", ErrorCode::bad_file, "ends within its head");
  refused(whole.substr(0, 40), ErrorCode::bad_file, "ends within the head of a record");
  refused(whole.substr(0, whole.size() - 60), ErrorCode::bad_file, "a record claims");
  refused(oni_file("NIX" + std::string(25, '\0')), ErrorCode::bad_file, "does not begin with NIR");
  std::string huge = whole;
  huge.replace(24 + 12, 8, "\xff\xff\xff\xff\xff\xff\xff\xff");
  refused(huge, ErrorCode::bad_file, "a record claims 4294967295 + 4294967295 bytes");
  refused(oni_file(test::oni_record(0x0D, 1, oni_number(~std::uint32_t{0}))), ErrorCode::bad_file,
          "type 13 end too early");
  refused(oni_file(depth_node()), ErrorCode::bad_file, "no depth image");
  refused(oni_file(depth_node("Im8z") + oni_data(1, 0, 1, "x")), ErrorCode::unsupported,
          "packed by Im8z");
  refused(oni_file(depth_node("16zT", 102) + oni_data(1, 0, 1, "x")), ErrorCode::unsupported,
          "pixel format 102");
  refused(oni_file(depth_node() + oni_data(1, 0, 1, "few")), ErrorCode::bad_file,
          "frame 0: 3 bytes of 16zT do not give 64 x 48 depths");
  refused(oni_file(oni_node(1, 2, "NONE", 1, 1u << 31, 1u << 31, 100) + oni_data(1, 0, 1, "x")),
          ErrorCode::bad_file, "2147483648 x 2147483648");
  refused(oni_file(depth_node() + oni_node(2, 3, "JPEG", 1, 8, 8, 200) +
                   oni_data(1, 0, 1, test::packed_16z(some_scene(0), true)) +
                   oni_data(2, 0, 1, "no JPEG")),
          ErrorCode::bad_file, "the colour image of frame 0");
}

TEST(ImportOni, KeepsItsPromisesForEveryTruncationAndTheSeeds) {
  const std::string whole = oni_file(some_oni());
  for (std::size_t size = 0; size < whole.size(); size += size < 1500 ? 1 : 101)
    test::expect_oni_promises_kept(std::string_view(whole).substr(0, size));
  const auto seeds = test::source_folder() / "fuzz" / "seeds" / "oni";
  for (const auto& entry : std::filesystem::directory_iterator(seeds))
    test::expect_oni_promises_kept(test::bytes_of(entry.path()));
}

}  // namespace
}  // namespace burnish
