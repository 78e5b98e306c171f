#include "burnish/sensor/recording_pclzf.h"

#include "burnish/io/geometry_file.h"
#include "sensor/recordings.h"
#include "support/recording_promises.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;
using test::expect_refused;
using test::raw;
using test::TemporaryFolder;
using test::write_text;

constexpr std::uint32_t kWidth = 40, kHeight = 30, kPixels = kWidth * kHeight;

/// LZF that packs nothing: runs of at most 32 bytes as they are.
std::string lzf(std::string_view bytes) {
  std::string packed;
  for (; !bytes.empty(); bytes.remove_prefix(std::min<std::size_t>(32, bytes.size()))) {
    const std::string_view run = bytes.substr(0, 32);
    packed += static_cast<char>(run.size() - 1);
    packed += run;
  }
  return packed;
}

std::string pclzf(std::string kind, const std::string& packed, std::uint32_t unpacked,
                  std::uint32_t width = kWidth, std::uint32_t height = kHeight) {
  kind.resize(16, ' ');
  return "PCLZF" + raw(width) + raw(height) + kind + raw(std::uint32_t(packed.size())) +
         raw(unpacked) + packed;
}

std::string depth_file(int image) {
  return pclzf("depth16", lzf(test::raw_depths(test::some_depths(kWidth, kHeight, image))),
               2 * kPixels);
}

std::string xml(double fx) {
  return "<?xml version=\"1.0\"?>\n<rgb>\n <focal_length_x>1</focal_length_x>\n</rgb>\n<depth>\n"
         "<focal_length_x> " +
         std::to_string(fx) +
         " </focal_length_x><focal_length_y>52"
         "</focal_length_y>\n<principal_point_x>20</principal_point_x>\n<principal_point_y>15"
         "</principal_point_y><z_multiplication_factor>0.002</z_multiplication_factor></depth>";
}

const std::string kNames[] = {"frame_20121214T142255.814212", "frame_20121214T142255.914212"};

void write_folder(const fs::path& folder) {
  const std::string planes =
      std::string(kPixels, 10) + std::string(kPixels, 20) + std::string(kPixels, 30);
  for (int i = 0; i < 2; ++i) {
    write_text(folder / (kNames[i] + "_depth.pclzf"), depth_file(i));
    write_text(folder / (kNames[i] + "_rgb.pclzf"), pclzf("rgb24", lzf(planes), 3 * kPixels));
    write_text(folder / (kNames[i] + ".xml"), xml(50));
  }
}

TEST(ImportPclzf, ReadsDepthColourCameraAndTime) {
  const TemporaryFolder folder;
  write_folder(folder / "in");
  const auto report = import_recording(folder / "in", folder / "out");
  ASSERT_TRUE(report) << report.error().text();
  EXPECT_EQ(report->frames, 2u);
  EXPECT_EQ(report->color_images, 2u);
  EXPECT_EQ(test::imported_depths(folder / "out", 1), test::some_depths(kWidth, kHeight, 1));
  const std::vector<Color> pixels(kPixels, Color{10, 20, 30, 255});
  EXPECT_EQ(test::bytes_of(folder / "out" / "frame-000000.color.png"),
            encode_png(kWidth, kHeight, pixels).value());
  const auto frames = open_frames({folder / "out"});
  ASSERT_TRUE(frames) << frames.error().text();
  EXPECT_EQ(frames->camera(), (Camera{kWidth, kHeight, 50, 52, 20, 15}));
  EXPECT_EQ(frames->read(0)->depth[1], float(0.002 * test::some_depths(kWidth, kHeight, 0)[1]));
  EXPECT_EQ(frames->files()[1].time, 1355494975.914212);  // 2012-12-14 14:22:55 UTC
}

TEST(ImportPclzf, RefusesWhatIsDamagedWithThePlace) {
  const TemporaryFolder folder;
  const std::string name = kNames[1] + "_depth.pclzf", sound = depth_file(1);
  const auto refused = [&](const std::string& bytes, ErrorCode code, const std::string& reason) {
    write_folder(folder / "in");
    write_text(folder / "in" / name, bytes);
    expect_refused(folder / "in", code, name + ", byte ", reason);
  };
  refused("", ErrorCode::bad_file, "does not begin");
  refused("P5 40 30 65535", ErrorCode::bad_file, "does not begin");
  refused(sound.substr(0, 30), ErrorCode::bad_file, "ends within its head");
  refused(sound.substr(0, sound.size() - 1), ErrorCode::bad_file, "packed bytes are claimed");
  refused(sound + "x", ErrorCode::bad_file, "packed bytes are claimed");
  refused(pclzf("depth17", "", 0), ErrorCode::unsupported, "'depth17'");
  refused(pclzf("depth16", "ab", 2 * kPixels + 2), ErrorCode::bad_file,
          "40 x 30 pixels of depth16");
  refused(pclzf("depth16", "ab", 0, 0), ErrorCode::bad_file, "0 x 30");
  refused(pclzf("depth16", "ab", 0, 65536, 65536), ErrorCode::bad_file, "65536 x 65536");
  refused(pclzf("depth16", "ab", 1u << 23, 2048, 2048), ErrorCode::bad_file,
          "2 packed bytes are claimed to give 8388608, 2 are there");
  std::string broken = sound;
  broken[37] = char(0xff);  // a copy of what came before the first byte
  refused(broken, ErrorCode::bad_file, "in what is packed");
}

TEST(ImportPclzf, RefusesCamerasThatAreDamagedOrChange) {
  const TemporaryFolder folder;
  const auto refused = [&](int frame, const std::string& text, const std::string& reason) {
    write_folder(folder / "in");
    write_text(folder / "in" / (kNames[frame] + ".xml"), text);
    expect_refused(folder / "in", ErrorCode::bad_file, kNames[frame] + ".xml", reason);
  };
  refused(0, "", "<focal_length_x> is expected within <depth>");
  refused(0, xml(50).substr(0, 200), "is expected within <depth>");
  refused(0, xml(-50), "must be positive");
  refused(1, xml(51), "not that of the first frame");
}

TEST(ImportPclzf, AtEveryTruncationThereIsAnError) {
  const std::string whole = depth_file(0);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const auto image = decode_pclzf(std::string_view(whole).substr(0, size), "cut");
    ASSERT_FALSE(image) << size;
    EXPECT_TRUE(image.error().where.starts_with("cut, byte ")) << image.error().text();
  }
  EXPECT_TRUE(decode_pclzf(whole, "whole"));
}

TEST(ImportPclzf, ARealFrameIsThatOfItsTiffAndItsCloud) {
  BURNISH_DATA_OR_SKIP(data, "depth/kinect_three_encodings");
  const std::string name = "frame_20121214T142255.814212";
  const TemporaryFolder folder;
  const auto report = import_recording(data / "pclzf", folder / "out");
  ASSERT_TRUE(report) << report.error().text();
  EXPECT_EQ(report->color_images, 1u);
  const auto tiff = read_depth_image(data / "tiff" / (name + "_depth.tiff"));
  const auto cloud = read_geometry(data / "pcd" / (name + ".pcd"));
  const auto frames =
      open_frames({folder / "out"}, {.poses = {}, .camera = {}, .sensor = "pinhole"});
  ASSERT_TRUE(tiff && cloud && frames) << frames.error().text();
  const auto frame = frames->read(0);
  const auto depths = test::imported_depths(folder / "out", 0);
  ASSERT_EQ(depths.size(), tiff->values.size());
  const auto& points = cloud->mesh.positions;
  ASSERT_EQ(depths.size(), points.size());
  for (std::size_t i = 0; i < depths.size(); ++i) {
    ASSERT_EQ(depths[i], tiff->values[i]) << i;
    if (depths[i] == 0) continue;
    // Their float arithmetic and ours: one unit in the last place of the metres.
    ASSERT_NEAR(points[i].z, frame->depth[i], 5e-7) << i;
    const Vec3d p = frame->camera.unproject(i % 640, i / 640, frame->depth[i]);
    ASSERT_NEAR(points[i].x, p.x, 2e-6) << i;
    ASSERT_NEAR(points[i].y, p.y, 2e-6) << i;
  }
}

/// What fuzzing begins with, and what it found.
TEST(ImportPclzf, KeepsItsPromisesForTheSeeds) {
  const auto seeds = test::source_folder() / "fuzz" / "seeds" / "pclzf";
  for (const auto& entry : std::filesystem::directory_iterator(seeds)) {
    test::expect_pclzf_promises_kept(test::bytes_of(entry.path()));
  }
}

}  // namespace
}  // namespace burnish
