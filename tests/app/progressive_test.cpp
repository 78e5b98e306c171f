// burnish progressive and burnish extract, as a user meets them.
#include "app/program.h"

#include <gtest/gtest.h>

#include <fstream>

#include "burnish/io/geometry_file.h"
#include "burnish/shapes/shapes.h"
#include "support/test_data.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;
using test::burnish;
using test::bytes_of;

/// A folder with a sphere as a mesh and as a progressive file.
class Progressive : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(write_mesh(original_, make_sphere(0.1, 4)));
    const test::Outcome outcome = burnish({"progressive", original_, "-o", file_});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("triangles 5120, "), std::string::npos) << outcome.out;
    EXPECT_LT(fs::file_size(file_), fs::file_size(original_));
  }

  std::size_t triangles(const std::vector<std::string>& options) const {
    const std::string output = folder_ / "out.ply";
    std::vector<std::string> words{"extract", file_, "-o", output};
    words.insert(words.end(), options.begin(), options.end());
    const test::Outcome outcome = burnish(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const auto mesh = read_mesh(output);
    return mesh ? mesh->triangles.size() : 0;
  }

  test::TemporaryFolder folder_;
  std::string original_ = folder_ / "sphere.ply", file_ = folder_ / "sphere.bpm";
};

TEST_F(Progressive, GivesTheOriginalToTheLastByte) {
  EXPECT_EQ(triangles({}), 5120u);
  EXPECT_EQ(bytes_of(folder_ / "out.ply"), bytes_of(original_));
}

TEST_F(Progressive, GivesLevelsByTrianglesAndByError) {
  const std::size_t some = triangles({"--triangles", "500"});
  EXPECT_LE(some, 500u);
  EXPECT_GE(some, 499u);
  const std::size_t rough = triangles({"--error", "10mm"});
  const std::size_t fine = triangles({"--error", "1mm"});
  EXPECT_LT(rough, fine);
  EXPECT_LT(fine, 5120u);
}

TEST_F(Progressive, IsFineInARegionAndCoarseOutside) {
  const std::size_t whole = triangles({});
  const std::size_t coarse = triangles({"--triangles", "0"});
  const std::string top = "box:-1,-1,0.05,1,1,1";
  const std::size_t cap = triangles({"--region", top});
  EXPECT_GT(cap, whole / 4);  // what lies above half of the radius
  EXPECT_LT(cap, whole / 2);
  const auto mesh = read_mesh(folder_ / "out.ply");
  ASSERT_TRUE(mesh);
  const std::size_t rich = triangles({"--region", top, "--outside_triangles", "1000"});
  EXPECT_GT(rich, cap + 500);
  const std::size_t near = triangles({"--region", "near:" + original_ + ",1m", "--error", "10mm"});
  EXPECT_GT(near, coarse);
  EXPECT_LT(near, whole / 2);
}

TEST_F(Progressive, RefusesWhatMeansNothing) {
  const std::string output = folder_ / "out.ply";
  const std::vector<std::vector<std::string>> wrong{
      {"--triangles", "5", "--error", "1mm"},
      {"--triangles", "5", "--region", "sphere:0,0,0,1"},
      {"--outside_triangles", "5"},
      {"--error", "-1mm"},
      {"--error", "wide"},
      {"--triangles", "-5"},
      {"--region", "cone:0,0,0,1"}};
  for (const auto& options : wrong) {
    std::vector<std::string> words{"extract", file_, "-o", output};
    words.insert(words.end(), options.begin(), options.end());
    const test::Outcome outcome = burnish(words);
    EXPECT_EQ(outcome.status, 2) << options[0] << " " << options[1];
    EXPECT_FALSE(outcome.err.empty());
  }
  EXPECT_FALSE(fs::exists(output));
  EXPECT_NE(burnish({"progressive", original_, "-o", folder_ / "sphere.stl"}).status, 0);
}

TEST_F(Progressive, SaysWhereAFileIsDamagedAndWhatCanBeHad) {
  std::string bytes = bytes_of(file_);
  bytes[bytes.size() / 2] ^= 4;
  std::ofstream(folder_ / "damaged.bpm", std::ios::binary) << bytes;
  const std::string output = folder_ / "out.ply";
  const test::Outcome outcome = burnish({"extract", folder_ / "damaged.bpm", "-o", output});
  EXPECT_NE(outcome.status, 0);
  EXPECT_NE(outcome.err.find("damaged.bpm, byte "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("record "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("can be had"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(output));
  EXPECT_EQ(
      burnish({"extract", folder_ / "damaged.bpm", "-o", output, "--triangles", "100"}).status, 0);
}

TEST(ProgressiveInterrupt, LeavesNoHalfFile) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_mesh(folder / "sphere.ply", make_sphere(0.1, 7)));
  const test::Outcome outcome =
      burnish({"progressive", folder / "sphere.ply", "-o", folder / "sphere.bpm"}, 300);
  EXPECT_EQ(outcome.status, 130);
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder.path())) ++files;
  EXPECT_EQ(files, 1u);
}

}  // namespace
}  // namespace burnish
