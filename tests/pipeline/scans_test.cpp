// What lies in a folder or a list of files, as scans.
#include "burnish/pipeline/scans.h"

#include <gtest/gtest.h>

#include <fstream>

#include "burnish/io/geometry_file.h"
#include "support/test_data.h"

namespace burnish {
namespace {

/// A patch of points around (x, 0, 1), with normals so that none need be estimated.
PointCloud patch_at(float x) {
  PointCloud cloud;
  for (int i = 0; i < 4; ++i) {
    cloud.positions.push_back({x + 0.001f * static_cast<float>(i % 2), 0.001f * float(i / 2), 1});
    cloud.attributes.normals.push_back({0, 0, -1});
  }
  return cloud;
}

/// Clouds number 1, 9 and 10, each with its number as x, and the poses of all in pose.txt.
void fill(const test::TemporaryFolder& folder) {
  for (const int number : {1, 9, 10}) {
    const auto file = folder / ("cloud" + std::to_string(number) + ".pcd");
    ASSERT_TRUE(write_cloud(file, patch_at(static_cast<float>(number))));
  }
  std::ofstream(folder / "pose.txt") << "10 0 0 0 0 0 1\n20 0 0 0 0 0 1\n30 0 0 0 0 0 1\n";
}

TEST(Scans, OfAFolderOfCloudsComeInNaturalOrderWithThePosesBesideThem) {
  const test::TemporaryFolder folder;
  fill(folder);
  const auto scans = open_scans({{folder.path()}, {}});
  ASSERT_TRUE(scans) << scans.error().text();
  ASSERT_EQ((*scans)->size(), 3u);
  const float expected[] = {11, 29, 40};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto scan = (*scans)->read(i, {});
    ASSERT_TRUE(scan) << scan.error().text();
    EXPECT_EQ(scan->cloud.positions.front().x, expected[i]);
  }
}

TEST(Scans, TakeThePosesThatAreGivenBeforeThoseBesideThem) {
  const test::TemporaryFolder folder;
  fill(folder);
  std::ofstream(folder / "other") << "1 0 0 0 0 0 1\n2 0 0 0 0 0 1\n3 0 0 0 0 0 1\n";
  FrameOptions frames;
  frames.poses = folder / "other";
  const auto scans = open_scans({{folder.path()}, frames});
  ASSERT_TRUE(scans) << scans.error().text();
  EXPECT_EQ((*scans)->read(2, {})->cloud.positions.front().x, 13);
  // Files named one by one have no poses but those that are given.
  const auto files = open_scans({{folder / "cloud1.pcd", folder / "cloud9.pcd"}, {}});
  ASSERT_FALSE(files);
  EXPECT_EQ(files.error().code, ErrorCode::invalid_argument);
}

TEST(Scans, LeaveOutPointsThatAreNotFiniteWithANote) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "dense.pcd") << "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT "
                                         "1 1 1\nWIDTH 5\nHEIGHT 1\nPOINTS 5\n"
                                         "DATA ascii\n0 0 1\nnan nan nan\n1 0 1\n0 1 1\nnan 0 1\n";
  const auto scans = open_scans({{folder / "dense.pcd"}, {}});
  ASSERT_TRUE(scans) << scans.error().text();
  const auto scan = (*scans)->read(0, {});
  ASSERT_TRUE(scan) << scan.error().text();
  EXPECT_EQ(scan->cloud.positions.size(), 3u);
  ASSERT_EQ(scan->notes.size(), 1u);
  EXPECT_NE(scan->notes[0].find("dense.pcd: 2 of 5 points are not finite and are left out"),
            std::string::npos)
      << scan->notes[0];
}

}  // namespace
}  // namespace burnish
