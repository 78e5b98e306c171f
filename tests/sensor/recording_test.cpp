// Folders that other programs write: TUM RGB-D, 7-Scenes, Redwood; and what all imports have in
// common.
#include "burnish/sensor/recording.h"

#include "sensor/recordings.h"
#include "support/progress.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;
using test::expect_refused;
using test::TemporaryFolder;
using test::write_text;

constexpr std::uint32_t kWidth = 8, kHeight = 6;

std::string some_png(int image) {
  const std::vector<Color> pixels(kWidth * kHeight,
                                  Color{static_cast<std::uint8_t>(image), 20, 30, 255});
  return encode_png(kWidth, kHeight, pixels).value();
}

void write_depth(const fs::path& path, int image) {
  test::write_depth(path, kWidth, kHeight, image);
}

/// Four depth images, three colour images, poses for all but the third depth image.
void write_tum(const fs::path& folder) {
  std::string depth = "# depth maps\n", rgb = "# colour images\n", truth = "# ground truth\n";
  for (int i = 0; i < 4; ++i) {
    const std::string time = std::to_string(100 + i) + ".000000";
    write_depth(folder / "depth" / (time + ".png"), i);
    depth += time + " depth/" + time + ".png\n";
    const std::string later = std::to_string(100 + i) + ".012000";
    if (i != 1) {
      write_text(folder / "rgb" / (later + ".png"), some_png(i));
      rgb += later + " rgb/" + later + ".png\n";
    }
    if (i != 2) truth += later + " " + std::to_string(i) + " 0 0 0 0 0 1\n";
  }
  write_text(folder / "depth.txt", depth);
  write_text(folder / "rgb.txt", rgb);
  write_text(folder / "groundtruth.txt", truth);
}

TEST(ImportTum, GivesEveryImageTheColourAndThePoseNearestInTime) {
  const TemporaryFolder folder;
  write_tum(folder / "tum");
  const auto report = import_recording(folder / "tum", folder / "out");
  ASSERT_TRUE(report) << report.error().text();
  EXPECT_EQ(report->frames, 3u);
  EXPECT_EQ(report->posed_frames, 3u);
  EXPECT_EQ(report->color_images, 2u);
  EXPECT_EQ(report->notes, (std::vector<std::string>{
                               "1 of 4 depth images have no pose within 0.02 s and are left out",
                               "1 of 3 depth images have no colour image within 0.02 s"}));
  EXPECT_EQ(test::files_below(folder / "out"),
            (std::vector<std::string>{"camera.txt", "depth.txt", "frame-000000.color.png",
                                      "frame-000000.depth.png", "frame-000000.pose.txt",
                                      "frame-000001.depth.png", "frame-000001.pose.txt",
                                      "frame-000002.color.png", "frame-000002.depth.png",
                                      "frame-000002.pose.txt", "recording.json", "rgb.txt"}));
  EXPECT_EQ(test::imported_depths(folder / "out", 2), test::some_depths(kWidth, kHeight, 3));
  EXPECT_EQ(test::bytes_of(folder / "out" / "frame-000002.color.png"), some_png(3));
  EXPECT_EQ(test::bytes_of(folder / "out" / "rgb.txt"),
            "# s, colour image\n100.012000 frame-000000.color.png\n"
            "103.012000 frame-000002.color.png\n");
}

TEST(ImportTum, WritesWhatOpenFramesReadsTheSame) {
  const TemporaryFolder folder;
  write_tum(folder / "tum");
  const Camera camera{0, 0, 10, 11, 3.5, 2.5};
  ASSERT_TRUE(import_recording(folder / "tum", folder / "out", {}, {camera, {}, "pinhole"}));
  FrameOptions options;
  options.camera = camera;
  options.sensor = "pinhole";
  const auto original = open_frames({folder / "tum"}, options);
  const auto imported = open_frames({folder / "out"});
  ASSERT_TRUE(original && imported) << imported.error().text();
  EXPECT_TRUE(imported->notes().empty());
  ASSERT_EQ(imported->size(), original->size());
  for (std::size_t i = 0; i < imported->size(); ++i) {
    EXPECT_EQ(imported->read(i).value(), original->read(i).value()) << i;
  }
}

TEST(ImportTum, KeepsAllFramesWherePosesAreNotWanted) {
  const TemporaryFolder folder;
  write_tum(folder / "tum");
  const auto report = import_recording(folder / "tum", folder / "out", {.poses = false});
  ASSERT_TRUE(report);
  EXPECT_EQ(report->frames, 4u);
  EXPECT_EQ(report->posed_frames, 0u);
  EXPECT_FALSE(fs::exists(folder / "out" / "frame-000000.pose.txt"));
}

TEST(ImportTum, TheTimeWindowDecidesWhatBelongsTogether) {
  const TemporaryFolder folder;
  write_tum(folder / "tum");
  // Colours and poses are 12 ms late.
  EXPECT_EQ(import_recording(folder / "tum", folder / "a", {.time_window = 0.0121})->color_images,
            2u);
  expect_refused(folder / "tum", ErrorCode::bad_file, "groundtruth.txt",
                 "none of its 3 poses is within 0.01 s", {.time_window = 0.01});
}

TEST(ImportTum, NamesWhatIsDamaged) {
  const TemporaryFolder folder;
  const fs::path tum = folder / "tum";
  const fs::path image = tum / "depth" / "101.000000.png";
  const auto damage = [&](const fs::path& file, const std::string& bytes) {
    fs::remove_all(tum);
    write_tum(tum);
    write_text(file, bytes);
  };
  damage(image, "");
  expect_refused(tum, ErrorCode::bad_file, "101.000000.png", "empty");
  fs::remove_all(tum);
  write_tum(tum);
  const std::string sound = test::bytes_of(image);
  damage(image, sound.substr(0, sound.size() / 2));
  expect_refused(tum, ErrorCode::bad_file, "101.000000.png", "damaged PNG");
  damage(image, some_png(1));
  expect_refused(tum, ErrorCode::unsupported, "101.000000.png", "colours");
  damage(tum / "depth.txt", "100.0 depth/100.000000.png\nnan depth/101.000000.png\n");
  expect_refused(tum, ErrorCode::bad_file, "depth.txt, line 2", "a timestamp and a file");
  damage(tum / "rgb.txt", "100.0 ../secret.png\n");
  expect_refused(tum, ErrorCode::bad_file, "rgb.txt, line 1", "below the folder");
  damage(tum / "groundtruth.txt", "100 0 0 0 0 0 0 1\n101 0 0 0\n");
  expect_refused(tum, ErrorCode::bad_file, "groundtruth.txt, line 2", "4 numbers");
  damage(tum / "rgb" / "100.012000.png", "no image");
  expect_refused(tum, ErrorCode::unsupported, "100.012000.png", "neither PNG nor JPEG");
  damage(image, sound);
  test::write_depth(image, 4, 4, 0);
  expect_refused(tum, ErrorCode::bad_file, "frame 1", "4 x 4 pixels, the first one 8 x 6");
}

TEST(ImportImages, TakesTheColoursAndPosesBesideSevenScenesFrames) {
  const TemporaryFolder folder;
  for (int i = 0; i < 2; ++i) {
    const std::string name = "frame-00000" + std::to_string(i);
    write_depth(folder / "seq" / (name + ".depth.png"), i);
    write_text(folder / "seq" / (name + ".color.png"), some_png(i));
    write_text(folder / "seq" / (name + ".pose.txt"), "1 0 0 0\n0 1 0 0\n0 0 1 7\n0 0 0 1\n");
  }
  const auto report = import_recording(folder / "seq", folder / "out");
  ASSERT_TRUE(report) << report.error().text();
  EXPECT_EQ(report->posed_frames, 2u);
  EXPECT_EQ(report->color_images, 2u);
  EXPECT_EQ(test::bytes_of(folder / "out" / "frame-000001.color.png"), some_png(1));
  EXPECT_FALSE(fs::exists(folder / "out" / "depth.txt"));
  EXPECT_EQ(open_frames({folder / "out"}, {.poses = {}, .camera = Camera{0, 0, 9, 9, 3, 3}})
                ->files()[1]
                .T_world_camera->translation,
            (Vec3d{0, 0, 7}));
}

TEST(ImportImages, TakesTheTrajectoryAndTheColoursBesideARedwoodFolder) {
  const TemporaryFolder folder;
  std::string trajectory;
  for (int i = 0; i < 2; ++i) {
    write_depth(folder / "scan" / "depth" / ("0000" + std::to_string(i) + ".png"), i);
    write_text(folder / "scan" / "image" / ("0000" + std::to_string(i) + ".jpg"),
               "\xff\xd8\xff jpeg " + std::to_string(i));
    trajectory +=
        std::to_string(i) + " 0 1\n1 0 0 " + std::to_string(i) + "\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
  }
  write_text(folder / "scan" / "trajectory.log", trajectory);
  const auto report = import_recording(folder / "scan", folder / "out");
  ASSERT_TRUE(report) << report.error().text();
  EXPECT_EQ(report->posed_frames, 2u);
  EXPECT_EQ(test::bytes_of(folder / "out" / "frame-000001.color.jpg"), "\xff\xd8\xff jpeg 1");

  write_depth(folder / "scan" / "depth" / "00002.png", 2);
  expect_refused(folder / "scan", ErrorCode::invalid_argument, "trajectory.log",
                 "2 poses for 3 depth images");
  const auto unposed = import_recording(folder / "scan", folder / "out", {.poses = false});
  ASSERT_TRUE(unposed);
  EXPECT_EQ(unposed->color_images, 0u);
  EXPECT_EQ(unposed->notes[0],
            "the 2 colour images are left out: there are 3 depth images, and the names tell no "
            "times");
}

TEST(ImportImages, TakesTheTimesThatRedwoodsNamesSay) {
  const TemporaryFolder folder;
  for (int i = 0; i < 3; ++i) {
    const std::string number = "000000" + std::to_string(i + 1);
    write_depth(folder / "o" / "depth" / (number + "-00000003333" + std::to_string(i) + ".png"), i);
  }
  write_text(folder / "o" / "rgb" / "0000001-000000040000.jpg", "\xff\xd8\xff");
  const auto report = import_recording(folder / "o", folder / "out", {.time_window = 0.00667});
  ASSERT_TRUE(report) << report.error().text();
  EXPECT_EQ(report->color_images, 2u);  // 33331 and 33332 microseconds, not 33330
  EXPECT_EQ(test::bytes_of(folder / "out" / "depth.txt").substr(17, 8), "0.033330");
}

TEST(Import, TakesEverySoManiethFrameAndNoMoreThanIsAskedFor) {
  const TemporaryFolder folder;
  for (int i = 0; i < 10; ++i) write_depth(folder / "in" / (std::to_string(i) + ".png"), i);
  EXPECT_EQ(import_recording(folder / "in", folder / "out", {.every = 3})->frames, 4u);
  EXPECT_EQ(test::imported_depths(folder / "out", 3), test::some_depths(kWidth, kHeight, 9));
  // A shorter import in the same place leaves nothing of the longer one.
  EXPECT_EQ(import_recording(folder / "in", folder / "out", {.every = 3, .frames = 2})->frames, 2u);
  EXPECT_EQ(test::files_below(folder / "out"),
            (std::vector<std::string>{"camera.txt", "frame-000000.depth.png",
                                      "frame-000001.depth.png", "recording.json"}));
}

TEST(Import, RemovesTheListsOfAnEarlierImport) {
  const TemporaryFolder folder;
  write_tum(folder / "tum");
  write_depth(folder / "in" / "0.png", 0);
  ASSERT_TRUE(import_recording(folder / "tum", folder / "out"));
  ASSERT_TRUE(import_recording(folder / "in", folder / "out"));
  EXPECT_EQ(test::files_below(folder / "out"),
            (std::vector<std::string>{"camera.txt", "frame-000000.depth.png", "recording.json"}));
}

TEST(Import, LeavesNothingWhereItIsCancelledAndReportsRisingProgress) {
  const TemporaryFolder folder;
  for (int i = 0; i < 5; ++i) write_depth(folder / "in" / (std::to_string(i) + ".png"), i);
  test::CancelAt cancel(0.5);
  const auto report = import_recording(folder / "in", folder / "out", {}, {}, cancel.context());
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::cancelled);
  EXPECT_FALSE(fs::exists(folder / "out"));

  test::ProgressLog log;
  Context context;
  context.sink = &log;
  ASSERT_TRUE(import_recording(folder / "in", folder / "out", {}, {}, context));
  EXPECT_TRUE(log.monotone());
  EXPECT_EQ(log.fractions().back(), 1);
}

TEST(Import, RefusesWhatItDoesNotKnowAndWhatCannotBe) {
  const TemporaryFolder folder;
  write_text(folder / "note.txt", "no recording");
  write_depth(folder / "in" / "0.png", 0);
  fs::create_directories(folder / "empty");
  expect_refused(folder / "none", ErrorCode::not_found, "none", "no such file");
  expect_refused(folder / "note.txt", ErrorCode::unsupported, "note.txt", "this file is no");
  expect_refused(folder / "empty", ErrorCode::unsupported, "empty", "this folder is no");
  expect_refused(folder / "in", ErrorCode::invalid_argument, "", "every", {.every = 0});
  ASSERT_TRUE(import_recording(folder / "in", folder / "out"));
  expect_refused(folder / "out", ErrorCode::invalid_argument, "out", "was imported");
  // A camera of another size, one that cannot be, and a folder with other people's files in it.
  const auto with = [&](const Camera& camera) {
    return import_recording(folder / "in", folder / "out", {}, {camera, {}, {}}).error().message;
  };
  EXPECT_EQ(with({640, 480, 525, 525, 320, 240}),
            "the depth images have 8 x 6 pixels, their camera 640 x 480");
  EXPECT_NE(with({0, 0, 525, 525, 9000, 240}).find("principal point"), std::string::npos);
  EXPECT_EQ(import_recording(folder / "in", folder / "in").error().code,
            ErrorCode::invalid_argument);
}

TEST(Import, KeepsRealRecordingsToTheBit) {
  BURNISH_DATA_OR_SKIP(kitchen, "depth/kinect_v1_kitchen");
  const TemporaryFolder folder;
  const auto report = import_recording(kitchen, folder / "out", {.every = 10});
  ASSERT_TRUE(report) << report.error().text();
  const auto original = open_frames({kitchen});
  const auto imported = open_frames({folder / "out"});
  ASSERT_TRUE(original && imported);
  ASSERT_EQ(imported->size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(imported->read(i).value(), original->read(10 * i).value());
  }
}

}  // namespace
}  // namespace burnish
