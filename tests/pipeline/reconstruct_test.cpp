#include "burnish/pipeline/reconstruct.h"

#include <gtest/gtest.h>

#include "burnish/core/topology.h"
#include "burnish/io/atomic_writer.h"
#include "burnish/io/geometry_file.h"
#include "burnish/sensor/camera_file.h"
#include "burnish/sensor/pose_list.h"
#include "burnish/sensor/turntable.h"
#include "burnish/shapes/shapes.h"
#include "support/test_data.h"

namespace burnish {
namespace {

namespace fs = std::filesystem;

Result<Reconstruction> made_from(std::vector<fs::path> paths, const FrameOptions& frames = {},
                                 const Recipe& recipe = {},
                                 const ReconstructOptions& options = {}) {
  return reconstruct({std::move(paths), frames}, recipe, options, {}, {});
}

/// What every mesh must be: finite, edge-manifold, of one orientation, and not next to nothing.
void expect_sound(const Result<Reconstruction>& made, std::size_t least_triangles) {
  ASSERT_TRUE(made) << made.error().text();
  const auto sound = check(made->mesh);
  EXPECT_TRUE(sound) << sound.error().text();
  const Topology t = topology(made->mesh);
  EXPECT_EQ(t.non_manifold_edges, 0u);
  EXPECT_EQ(t.flipped_edges, 0u);
  EXPECT_GE(made->mesh.triangles.size(), least_triangles);
  EXPECT_EQ(made->mesh.attributes.sigma.size(), made->mesh.positions.size());
  EXPECT_EQ(made->mesh.attributes.origin.size(), made->mesh.positions.size());
}

double fact(const Facts& facts, std::string_view key) {
  for (const Fact& f : facts) {
    if (f.key == key) return f.value;
  }
  ADD_FAILURE() << "no fact " << key;
  return 0;
}

/// The demo's promise: the mesh's vertices are at most half as far from the teapot as the raw
/// points.
TEST(Reconstruct, HalvesTheErrorOfAScannedTeapot) {
  const test::TemporaryFolder folder;
  const auto model = make_shape("teapot");
  const auto sensor = find_sensor("kinect_v1");
  ASSERT_TRUE(model && sensor);
  ASSERT_TRUE(simulate_turntable(*model, *sensor, {.views = 24}, folder / "scan"));
  const auto made =
      made_from({folder / "scan"}, {}, {}, {.truth = folder / "scan" / "truth" / "model.ply"});
  expect_sound(made, 20000);
  const auto& comparisons = made->record.comparisons;
  ASSERT_EQ(comparisons.front().first, "raw points");
  ASSERT_EQ(comparisons.back().first, "phase 1");
  EXPECT_LE(fact(comparisons.back().second, "vertices_rms"),
            0.5 * fact(comparisons.front().second, "rms"));
  EXPECT_EQ(made->record.phases.back().mesh, made->mesh);
  EXPECT_EQ(made->record.phases.back().deviation.size(), made->mesh.positions.size());
}

TEST(Reconstruct, RecordsEveryStepWithEveryParameter) {
  const test::TemporaryFolder folder;
  const auto sensor = find_sensor("kinect_v1");
  ASSERT_TRUE(simulate_turntable(make_sphere(0.15, 4), *sensor, {.views = 3}, folder / "scan"));
  const auto made = made_from({folder / "scan"});
  expect_sound(made, 500);
  std::string verbs;
  for (const Step& step : made->record.steps) {
    verbs += step.verb + " " + step.method + ", ";
    EXPECT_EQ(step.settings.size(), step.fields.size()) << step.method;
    EXPECT_GE(step.seconds, 0);
  }
  EXPECT_EQ(verbs,
            "read scans, clean flying_pixels, merge cells, clean outliers, triangulate global, "
            "repair small_components, smooth auto, ");
}

TEST(Reconstruct, FusesFramesInAVolume) {
  const test::TemporaryFolder folder;
  const auto sensor = find_sensor("kinect_v1");
  const TriangleMesh model = make_sphere(0.15, 4);
  ASSERT_TRUE(simulate_turntable(model, *sensor, {.views = 6}, folder / "scan"));
  Recipe recipe;
  recipe.merge = {"volume", {{"voxel", "4mm"}}};
  const auto made =
      made_from({folder / "scan"}, {}, recipe, {.truth = folder / "scan" / "truth" / "model.ply"});
  expect_sound(made, 5000);
  std::string verbs;
  for (const Step& step : made->record.steps) {
    verbs += step.verb + " " + step.method + ", ";
    EXPECT_EQ(step.settings.size(), step.fields.size()) << step.method;
  }
  EXPECT_EQ(
      verbs,
      "read scans, clean flying_pixels, merge volume, repair small_components, smooth auto, ");
  const auto& comparisons = made->record.comparisons;
  EXPECT_LE(fact(comparisons.back().second, "vertices_rms"),
            0.5 * fact(comparisons.front().second, "rms"));

  recipe.triangulate = {"global", {}};
  const auto twice = made_from({folder / "scan"}, {}, recipe);
  ASSERT_FALSE(twice);
  EXPECT_EQ(twice.error().code, ErrorCode::invalid_argument);

  recipe.triangulate = {};
  ASSERT_TRUE(write_mesh(folder / "cloud.ply", model));
  const auto of_clouds = made_from({folder / "cloud.ply"}, {}, recipe);
  ASSERT_FALSE(of_clouds);
  EXPECT_EQ(of_clouds.error().code, ErrorCode::invalid_argument) << of_clouds.error().text();
}

TEST(Reconstruct, SimplifiesLastAndKeepsThePhases) {
  const test::TemporaryFolder folder;
  const auto sensor = find_sensor("kinect_v1");
  ASSERT_TRUE(simulate_turntable(make_sphere(0.15, 4), *sensor, {.views = 3}, folder / "scan"));
  Recipe recipe;
  recipe.simplify = {{"quadric", {{"ratio", "0.2"}}}};
  const auto made = made_from({folder / "scan"}, {}, recipe, {.truth = {}, .keep_phases = true});
  expect_sound(made, 100);
  const std::vector<Phase>& phases = made->record.phases;
  ASSERT_EQ(phases.size(), 3u);
  EXPECT_EQ(phases[0].name, "original");
  EXPECT_EQ(phases[2].name, "phase 2");
  EXPECT_EQ(phases[2].mesh, made->mesh);
  EXPECT_LE(phases[2].mesh.triangles.size(), phases[1].mesh.triangles.size() / 5 + 2);
  EXPECT_EQ(made->record.steps.back().verb, "simplify");
}

TEST(Reconstruct, CropsInWorldCoordinates) {
  const test::TemporaryFolder folder;
  const auto sensor = find_sensor("kinect_v1");
  ASSERT_TRUE(
      simulate_turntable(make_sphere(0.15, 4), *sensor, {.views = 3, .noise = 0}, folder / "scan"));
  Recipe recipe;
  recipe.crop = Box{{-1, -1, 0}, {1, 1, 1}};
  recipe.smooth = {};
  const auto made = made_from({folder / "scan"}, {}, recipe);
  expect_sound(made, 100);
  for (const Vec3f& p : made->mesh.positions) {
    // Merging averages points inside of the box; it cannot leave it.
    EXPECT_GE(p.z, -1e-6f);
  }
}

/// Coordinates of a map: float would have steps of half a metre there.
TEST(Reconstruct, IsAsGoodFarFromTheWorldsOrigin) {
  const test::TemporaryFolder folder;
  const auto sensor = find_sensor("kinect_v1");
  ASSERT_TRUE(simulate_turntable(make_sphere(0.15, 4), *sensor, {.views = 3}, folder / "scan"));
  const auto near = made_from({folder / "scan"});
  expect_sound(near, 500);
  for (const char* name : {"frame-000000", "frame-000001", "frame-000002"}) {
    const fs::path file = folder / "scan" / (std::string(name) + ".pose.txt");
    auto pose = read_pose_matrix(file);
    ASSERT_TRUE(pose);
    pose->translation += Vec3d{500000, 4649776, 0};
    ASSERT_TRUE(write_file(file, pose_matrix_text(*pose)));
  }
  const auto far = made_from({folder / "scan"});
  expect_sound(far, 500);
  // Rounding differs, so that single points may come out otherwise.
  EXPECT_NEAR(static_cast<double>(far->mesh.triangles.size()),
              static_cast<double>(near->mesh.triangles.size()), 0.01 * near->mesh.triangles.size());
  EXPECT_NEAR(far->mesh.frame.origin.y, 4649776, 10);
}

TEST(Reconstruct, CancelsWithoutAResult) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_mesh(folder / "sphere.ply", make_sphere()));
  std::stop_source source;
  source.request_stop();
  Context context;
  context.stop = source.get_token();
  const auto made = reconstruct({{folder / "sphere.ply"}, {}}, {}, {}, {}, context);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::cancelled);
}

TEST(Reconstruct, RefusesFramesAmongClouds) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_mesh(folder / "sphere.ply", make_sphere()));
  const auto made = made_from({folder / "sphere.ply", folder.path()});
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::invalid_argument);
}

TEST(Reconstruct, RefusesAnotherNumberOfPosesThanClouds) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_mesh(folder / "sphere.ply", make_sphere()));
  ASSERT_TRUE(write_file(folder / "poses.txt", "0 0 0 0 0 0 1\n0 0 0 0 0 0 1\n"));
  const auto made = made_from({folder / "sphere.ply"}, {.poses = folder / "poses.txt"});
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().text().find("2 poses for 1"), std::string::npos) << made.error().text();
}

TEST(ReconstructRealScans, SixKitchenFrames) {
  BURNISH_DATA_OR_SKIP(kitchen, "depth/kinect_v1_kitchen");
  const test::TemporaryFolder folder;
  fs::copy_file(kitchen / "camera-intrinsics.txt", folder / "camera-intrinsics.txt");
  for (const char* number : {"000", "050", "100", "150", "200", "250"}) {
    for (const char* ending : {".depth.png", ".pose.txt"}) {
      const std::string name = std::string("frame-000") + number + ending;
      fs::copy_file(kitchen / name, folder / name);
    }
  }
  expect_sound(made_from({folder.path()}), 200000);
}

TEST(ReconstructRealScans, FivePosedFrames) {
  BURNISH_DATA_OR_SKIP(five, "depth/kinect_five_posed");
  expect_sound(made_from({five}, {.camera = *parse_camera("518,519,325.5,253.5")}), 100000);
}

TEST(ReconstructRealScans, AFrameOfAPerson) {
  BURNISH_DATA_OR_SKIP(person, "depth/primesense/depth.png");
  expect_sound(made_from({person}), 400000);
}

TEST(ReconstructRealScans, ATableTop) {
  BURNISH_DATA_OR_SKIP(table, "depth/kinect_tabletop/learn/learn0.pcd");
  expect_sound(made_from({table}), 300000);
}

}  // namespace
}  // namespace burnish
