// What is written comes back to the bit, or the report says that it does not.
#include <gtest/gtest.h>

#include "samples.h"

namespace burnish {
namespace {

using test::any_attributes;
using test::any_mesh;
using test::same_bits;

void expect_same(const Attributes& a, const Attributes& b) {
  EXPECT_TRUE(same_bits(a.normals, b.normals));
  EXPECT_TRUE(same_bits(a.colors, b.colors));
  EXPECT_TRUE(same_bits(a.sigma, b.sigma));
  EXPECT_TRUE(same_bits(a.noise, b.noise));
  EXPECT_TRUE(same_bits(a.observations, b.observations));
  EXPECT_TRUE(same_bits(a.origin, b.origin));
  ASSERT_EQ(a.channels.size(), b.channels.size());
  for (std::size_t c = 0; c < a.channels.size(); ++c) {
    EXPECT_EQ(a.channels[c].name, b.channels[c].name);
    ASSERT_EQ(a.channels[c].values.index(), b.channels[c].values.index()) << a.channels[c].name;
    std::visit(
        [&](const auto& values) {
          EXPECT_TRUE(same_bits(
              values, std::get<std::remove_cvref_t<decltype(values)>>(b.channels[c].values)))
              << a.channels[c].name;
        },
        a.channels[c].values);
  }
}

struct Way {
  const char* extension;
  bool ascii;
};

void PrintTo(const Way& way, std::ostream* out) {
  *out << way.extension << (way.ascii ? " ascii" : "");
}

class RoundTrip : public testing::TestWithParam<Way> {
 protected:
  std::filesystem::path path() const {
    return folder_ / (std::string("file") + GetParam().extension);
  }
  WriteOptions options() const { return {GetParam().ascii, {"a comment\nof two lines"}}; }

  TriangleMesh there_and_back(const TriangleMesh& mesh, std::size_t notes = 0) {
    const auto written = write_mesh(path(), mesh, options());
    EXPECT_TRUE(written) << written.error().text();
    EXPECT_EQ(written.value_or(WriteReport{}).notes.size(), notes);
    const auto file = read_geometry(path());
    EXPECT_TRUE(file) << file.error().text();
    return file ? file->mesh : TriangleMesh{};
  }

  test::TemporaryFolder folder_;
};

using EveryMeshFormat = RoundTrip;
INSTANTIATE_TEST_SUITE_P(Io, EveryMeshFormat,
                         testing::Values(Way{".ply", false}, Way{".ply", true}, Way{".obj", true},
                                         Way{".off", true}));

TEST_P(EveryMeshFormat, KeepsPositionsAndTriangles) {
  const TriangleMesh mesh = any_mesh(1);
  const TriangleMesh back = there_and_back(mesh);
  EXPECT_TRUE(same_bits(back.positions, mesh.positions));
  EXPECT_EQ(back.triangles, mesh.triangles);
}

TEST_P(EveryMeshFormat, KeepsNormalsAndOpaqueColors) {
  TriangleMesh mesh = any_mesh(2);
  mesh.attributes.normals = any_attributes(2, 300).normals;
  mesh.attributes.colors = any_attributes(2, 300).colors;
  for (Color& color : mesh.attributes.colors) color[3] = 255;
  const TriangleMesh back = there_and_back(mesh);
  expect_same(back.attributes, mesh.attributes);
}

TEST_P(EveryMeshFormat, KeepsLargeCoordinatesToTheMillimetre) {
  TriangleMesh mesh = any_mesh(3, 100, 100);
  mesh.frame.origin = {512000, 5403200, -64};
  Random random(4);
  for (Vec3f& p : mesh.positions) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      p[axis] = static_cast<float>(random.uniform(-1, 1));
  }
  const TriangleMesh back = there_and_back(mesh);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3d before = mesh.frame.origin + Vec3d(mesh.positions[v]);
    const Vec3d after = back.frame.origin + Vec3d(back.positions[v]);
    // Half a float step at the extent (2), and one of a double at the coordinate.
    EXPECT_LE(norm(after - before), 2 * (0x1p-24 * 2 + 0x1p-52 * 5403200)) << v;
  }
}

using EveryAttributeFormat = RoundTrip;
INSTANTIATE_TEST_SUITE_P(Io, EveryAttributeFormat,
                         testing::Values(Way{".ply", false}, Way{".ply", true}, Way{".pcd", false},
                                         Way{".pcd", true}));

TEST_P(EveryAttributeFormat, KeepsEveryAttributeOfAnOrganizedCloud) {
  const PointCloud cloud = test::any_organized_cloud(5);
  const auto written = write_cloud(path(), cloud, options());
  ASSERT_TRUE(written) << written.error().text();
  EXPECT_TRUE(written->notes.empty());
  const auto back = read_cloud(path());
  ASSERT_TRUE(back) << back.error().text();
  EXPECT_EQ(back->grid, cloud.grid);
  EXPECT_EQ(back->viewpoint, cloud.viewpoint);
  EXPECT_TRUE(same_bits(back->positions, cloud.positions));
  expect_same(back->attributes, cloud.attributes);
}

TEST_P(EveryAttributeFormat, KeepsTheFrameToTheBit) {
  PointCloud cloud;
  cloud.frame.origin = {512000, 5403200, -64};
  Random random(6);
  for (int i = 0; i < 500; ++i) {
    Vec3f p;
    for (std::size_t axis = 0; axis < 3; ++axis)
      p[axis] = static_cast<float>(random.uniform(-100, 100));
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = std::round(p[axis] * 1024) / 1024;
    cloud.positions.push_back(p);
  }
  ASSERT_TRUE(write_cloud(path(), cloud, options()));
  const auto back = read_cloud(path());
  ASSERT_TRUE(back);
  EXPECT_EQ(*back, cloud);
}

TEST(PlyRoundTrip, KeepsEveryAttributeOfAMesh) {
  const test::TemporaryFolder folder;
  TriangleMesh mesh = any_mesh(7);
  mesh.attributes = any_attributes(7, 300);
  const TriangleAttributes known = test::any_triangle_attributes(7, 500, 300);
  for (const bool ascii : {false, true}) {
    for (const TriangleAttributes& part :
         {TriangleAttributes{}, TriangleAttributes{known.origin, {}},
          TriangleAttributes{{}, known.owner}, known}) {
      mesh.triangle_attributes = part;
      const auto written = write_mesh(folder / "mesh.ply", mesh, {ascii, {}});
      ASSERT_TRUE(written) << written.error().text();
      EXPECT_TRUE(written->notes.empty());
      const auto back = read_mesh(folder / "mesh.ply");
      ASSERT_TRUE(back) << back.error().text();
      EXPECT_EQ(back->triangles, mesh.triangles);
      EXPECT_EQ(back->triangle_attributes, mesh.triangle_attributes);
      expect_same(back->attributes, mesh.attributes);
    }
  }
}

TEST(StlRoundTrip, KeepsTrianglesToTheBit) {
  const test::TemporaryFolder folder;
  TriangleMesh
      mesh;  // vertices in the order of their first use, so that welding gives the same numbers
  Random random(8);
  for (std::uint32_t i = 0; i < 300; ++i) mesh.positions.push_back(test::any_vector(random));
  for (std::uint32_t i = 0; i + 2 < 300; ++i) mesh.triangles.push_back({i, i + 1, i + 2});
  for (const bool ascii : {false, true}) {
    ASSERT_TRUE(write_mesh(folder / "mesh.stl", mesh, {ascii, {}}));
    const auto back = read_mesh(folder / "mesh.stl");
    ASSERT_TRUE(back) << back.error().text();
    EXPECT_TRUE(same_bits(back->positions, mesh.positions));
    EXPECT_EQ(back->triangles, mesh.triangles);
  }
}

TEST(Write, SaysWhatAFormatCannotHold) {
  const test::TemporaryFolder folder;
  TriangleMesh mesh = any_mesh(9);
  mesh.attributes = any_attributes(9, 300);
  mesh.triangle_attributes = test::any_triangle_attributes(9, 500, 300);
  const auto obj = write_mesh(folder / "mesh.obj", mesh);
  ASSERT_TRUE(obj);
  // Alpha; sigma, noise, observations, origin; the channels; origin and owner of triangles.
  EXPECT_EQ(obj->notes.size(), 1 + 4 + 8 + 2u);
  EXPECT_EQ(obj->notes.back(), "OBJ cannot hold the owner of triangles: left out");
  const auto stl = write_mesh(folder / "mesh.stl", mesh);
  ASSERT_TRUE(stl);
  EXPECT_EQ(stl->notes.size(),
            2 + 4 + 8 + 2 + 1u);  // normals, colours; ...; vertices that nothing uses
}

TEST(Write, RefusesToLoseGeometry) {
  const test::TemporaryFolder folder;
  const auto mesh = write_mesh(folder / "mesh.pcd", any_mesh(1));
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().code, ErrorCode::unsupported);
  PointCloud points;
  points.positions = {{1, 2, 3}};
  const auto cloud = write_cloud(folder / "cloud.stl", points);
  ASSERT_FALSE(cloud);
  EXPECT_EQ(cloud.error().code, ErrorCode::unsupported);
  EXPECT_NE(cloud.error().where.find("cloud.stl"), std::string::npos);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Write, RefusesABrokenMeshAChannelNameOfTwoWordsAndAnUnknownExtension) {
  const test::TemporaryFolder folder;
  TriangleMesh mesh = any_mesh(1);
  EXPECT_EQ(write_mesh(folder / "mesh.doc", mesh).error().code, ErrorCode::unsupported);
  mesh.attributes.channels.push_back({"two words", std::vector<float>(300)});
  EXPECT_EQ(write_mesh(folder / "mesh.ply", mesh).error().code, ErrorCode::invalid_argument);
  mesh.attributes.channels[0].name = "x";
  EXPECT_EQ(write_mesh(folder / "mesh.ply", mesh).error().code, ErrorCode::invalid_argument);
  mesh.triangles.push_back({0, 1, 300});
  EXPECT_EQ(write_mesh(folder / "mesh.ply", mesh).error().code, ErrorCode::bad_geometry);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Write, LeavesOutMissingPixelsWhereThereIsNoGrid) {
  const test::TemporaryFolder folder;
  const PointCloud cloud = test::any_organized_cloud(3);
  const auto written = write_cloud(folder / "cloud.off", cloud);
  ASSERT_TRUE(written);
  EXPECT_NE(written->notes.back().find("43 missing pixels"), std::string::npos)
      << written->notes.back();
  EXPECT_EQ(read_cloud(folder / "cloud.off")->positions.size(), 300 - 43u);
}

/// Asks for a stop at the first sign of progress.
class StopAtOnce : public ProgressSink {
 public:
  void on_progress(double) override { source.request_stop(); }
  std::stop_source source;
};

TEST(Write, LeavesNothingBehindWhenCancelled) {
  for (const char* name : {"m.ply", "m.obj", "m.off", "m.stl"}) {
    const test::TemporaryFolder folder;
    StopAtOnce stop;
    Context context;
    context.sink = &stop;
    context.stop = stop.source.get_token();
    const auto written = write_mesh(folder / name, any_mesh(1, 20000, 20000), {}, context);
    ASSERT_FALSE(written) << name;
    EXPECT_EQ(written.error().code, ErrorCode::cancelled);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << name;
  }
}

class Recorder : public ProgressSink {
 public:
  void on_progress(double fraction) override { seen.push_back(fraction); }
  std::vector<double> seen;
};

TEST(Progress, RisesToOneInReadingAndWriting) {
  const test::TemporaryFolder folder;
  TriangleMesh mesh = any_mesh(1, 20000, 20000);
  mesh.frame.origin = {1e6, 0, 0};
  for (Vec3f& p : mesh.positions) p = normalized(p);
  for (const char* name : {"m.ply", "m.obj", "m.off", "m.stl"}) {
    Recorder recorder;
    Context context;
    context.sink = &recorder;
    ASSERT_TRUE(write_mesh(folder / name, mesh, {}, context));
    EXPECT_TRUE(std::is_sorted(recorder.seen.begin(), recorder.seen.end())) << name;
    EXPECT_EQ(recorder.seen.back(), 1);
    recorder.seen.clear();
    ASSERT_TRUE(read_geometry(folder / name, context));
    EXPECT_TRUE(std::is_sorted(recorder.seen.begin(), recorder.seen.end())) << name;
    EXPECT_GT(recorder.seen.size(), 2u);
    EXPECT_EQ(recorder.seen.back(), 1);
  }
}

}  // namespace
}  // namespace burnish
