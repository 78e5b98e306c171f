#include "burnish/sensor/recording_klg.h"

#include <zlib.h>

#include "sensor/recordings.h"
#include "support/peak_memory.h"
#include "support/recording_promises.h"

namespace burnish {
namespace {

using test::expect_refused;
using test::raw;
using test::TemporaryFolder;
using test::write_text;

constexpr std::uint32_t kWidth = 160, kHeight = 120;
constexpr std::size_t kPixels = kWidth * kHeight;

std::string packed(std::string_view bytes) {
  uLongf size = compressBound(bytes.size());
  std::string result(size, 0);
  compress(reinterpret_cast<Bytef*>(result.data()), &size,
           reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  result.resize(size);
  return result;
}

std::string depth_bytes(int image) {
  return test::raw_depths(test::some_depths(kWidth, kHeight, image));
}

std::string frame(std::int64_t microseconds, const std::string& depth, const std::string& color) {
  return raw(microseconds) + raw(std::int32_t(depth.size())) + raw(std::int32_t(color.size())) +
         depth + color;
}

const std::string kJpeg = "\xff\xd8\xff some JPEG";

/// Three frames: packed with JPEG, as it is with red pixels, packed without colour.
std::string some_klg(std::int32_t count = 3) {
  std::string red;
  for (std::size_t i = 0; i < kPixels; ++i) red += std::string("\xc8\x00\x00", 3);
  return raw(count) + frame(1000000, packed(depth_bytes(0)), kJpeg) +
         frame(1033333, depth_bytes(1), red) + frame(1066667, packed(depth_bytes(2)), "");
}

TEST(ImportKlg, ReadsPackedAndPlainDepthAndColour) {
  const TemporaryFolder folder;
  write_text(folder / "log", some_klg());  // told by its content: it has no ending
  const auto report = import_recording(folder / "log", folder / "out");
  ASSERT_TRUE(report) << report.error().text();
  EXPECT_EQ(report->frames, 3u);
  EXPECT_EQ(report->color_images, 2u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(test::imported_depths(folder / "out", i), test::some_depths(kWidth, kHeight, i));
  }
  EXPECT_EQ(test::bytes_of(folder / "out" / "frame-000000.color.jpg"), kJpeg);
  const std::vector<Color> red(kPixels, Color{0xc8, 0, 0, 255});
  EXPECT_EQ(test::bytes_of(folder / "out" / "frame-000001.color.png"),
            encode_png(kWidth, kHeight, red).value());
  EXPECT_EQ(test::bytes_of(folder / "out" / "depth.txt"),
            "# s, depth image\n1.000000 frame-000000.depth.png\n1.033333 frame-000001.depth.png\n"
            "1.066667 frame-000002.depth.png\n");
  const auto frames =
      open_frames({folder / "out"}, {.poses = {}, .camera = Camera{0, 0, 9, 9, 80, 60}});
  ASSERT_TRUE(frames) << frames.error().text();
  EXPECT_EQ(frames->read(2)->time, 1.066667);
  EXPECT_EQ(frames->read(2)->depth[1], float(0.001 * test::some_depths(kWidth, kHeight, 2)[1]));
}

TEST(ImportKlg, RefusesCountsThatAreWrongWithThePlace) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& bytes, const std::string& place,
                           const std::string& reason) {
    write_text(folder / "log.klg", bytes);
    expect_refused(folder / "log.klg", ErrorCode::bad_file, "log.klg, " + place, reason);
  };
  refused("", "byte 0", "ends within the count");
  refused(some_klg(0), "byte 4", "counts 0 frames");
  refused(some_klg(-5), "byte 4", "counts -5 frames");
  refused(some_klg(2), "byte ", "counts 2 frames, ");
  refused(some_klg(0x7fffffff), "byte ", "before frame 3 of the 2147483647");
  const std::string first = raw(std::int32_t{1}) + raw(std::int64_t{0});
  refused(first + raw(std::int32_t{0x7fffffff}) + raw(std::int32_t{0x7fffffff}) + "..", "byte 4",
          "frame 0 of 1 claims 2147483647 bytes of depth and 2147483647 of colour, 2 are left");
  refused(first + raw(std::int32_t{-1}) + raw(std::int32_t{1}), "byte 4", "claims -1 bytes");
}

TEST(ImportKlg, RefusesFramesThatAreDamagedWithThePlace) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& frames, std::int32_t count, ErrorCode code,
                           const std::string& reason) {
    write_text(folder / "log.klg", raw(count) + frames);
    expect_refused(folder / "log.klg", code, "log.klg, byte ", reason);
  };
  const std::string sound = frame(0, packed(depth_bytes(0)), "");
  std::string broken = packed(depth_bytes(1));
  for (std::size_t i = 40; i < 60; ++i) broken[i] = char(255 - broken[i]);
  refused(sound + frame(1, broken, ""), 2, ErrorCode::bad_file, "frame 1: the depth is a damaged");
  refused(frame(1, packed(depth_bytes(1)).substr(0, 90), ""), 1, ErrorCode::bad_file,
          "damaged zlib stream");
  refused(frame(1, packed(depth_bytes(1)) + "x", ""), 1, ErrorCode::bad_file,
          "damaged zlib stream");
  refused(frame(1, packed("few"), ""), 1, ErrorCode::unsupported, "3 bytes of depth");
  refused(frame(1, "no depth at all", ""), 1, ErrorCode::unsupported, "15 bytes of depth");
  refused(frame(1, packed(depth_bytes(0)), "no colour"), 1, ErrorCode::bad_file,
          "9 bytes of colour are neither JPEG nor 160 x 120 x 3");
  // More than any depth image has.
  refused(frame(1, packed(std::string((std::size_t{1} << 24) + 1, 0)), ""), 1, ErrorCode::bad_file,
          "damaged zlib stream");
}

TEST(ImportKlg, AtEveryTruncationThereIsAnError) {
  const std::string whole = raw(std::int32_t{1}) + frame(7, packed(depth_bytes(0)), kJpeg);
  for (std::size_t size = 0; size < whole.size(); size += size < 64 ? 1 : 997) {
    const auto recording = open_klg(std::string_view(whole).substr(0, size), "cut.klg");
    ASSERT_FALSE(recording) << size;
    EXPECT_TRUE(recording.error().where.starts_with("cut.klg, byte ")) << recording.error().text();
  }
  EXPECT_TRUE(open_klg(whole, "whole.klg"));
}

TEST(ImportKlg, HoldsOneFrameAtATime) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers have memory of their own";
#endif
  const TemporaryFolder folder;
  const std::string depth = packed(std::string(std::size_t{2} << 20, 0));  // 1024 x 1024
  std::string bytes = raw(std::int32_t{16});
  for (int i = 0; i < 16; ++i) bytes += frame(i, depth, "");
  write_text(folder / "log", bytes);
  const std::size_t peak = test::peak_memory_of(
      [&] { return import_recording(folder / "log", folder / "out").has_value(); });
  // All of them have 32 MB; one has 2, and again as many while it is unpacked and counted.
  EXPECT_LT(peak, std::size_t{16} << 20);
}

/// What fuzzing begins with, and what it found.
TEST(ImportKlg, KeepsItsPromisesForTheSeeds) {
  const auto seeds = test::source_folder() / "fuzz" / "seeds" / "klg";
  for (const auto& entry : std::filesystem::directory_iterator(seeds)) {
    test::expect_klg_promises_kept(test::bytes_of(entry.path()));
  }
}

}  // namespace
}  // namespace burnish
