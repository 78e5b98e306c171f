#include "burnish/measure/truth.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "burnish/shapes/shapes.h"

namespace burnish {
namespace {

TEST(CompareToTruth, SpheresAtAKnownDistance) {
  // The gap between spheres of 5 subdivisions is 0.01 less at most the sag of their facets.
  const double sag = 3e-4;
  const auto result = compare_to_truth(make_sphere(1.01, 5), make_sphere(1, 5), {.samples = 20000});
  ASSERT_TRUE(result);
  for (const Distances& d : {result->to_truth, result->vertices, result->from_truth}) {
    EXPECT_NEAR(d.rms, 0.01, sag);
    EXPECT_NEAR(d.mean, 0.01, sag);
    EXPECT_NEAR(d.p95, 0.01, sag);
    EXPECT_NEAR(d.max, 0.01, sag);
    EXPECT_LE(d.mean, d.rms);
    EXPECT_LE(d.p95, d.max);
  }
  EXPECT_NEAR(result->hausdorff(), 0.01, sag);
  // Both are facetted alike: what is left is where the nearest point is on a neighbouring facet.
  EXPECT_LT(result->mean_normal_error, 0.005);
}

TEST(CompareToTruth, AShiftedPlaneIsExact) {
  TriangleMesh mesh = make_grid(4, 4, 0.25);
  const TriangleMesh truth = mesh;
  for (Vec3f& p : mesh.positions) p.z = 0.125f;
  const auto result = compare_to_truth(mesh, truth, {.samples = 1000});
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->to_truth.rms, 0.125, 1e-12);
  EXPECT_NEAR(result->to_truth.max, 0.125, 1e-12);
  EXPECT_NEAR(result->from_truth.mean, 0.125, 1e-12);
  EXPECT_EQ(result->mean_normal_error, 0);
  EXPECT_EQ(result->to_truth.count, 1000u);
  EXPECT_EQ(result->vertices.count, 25u);
}

TEST(CompareToTruth, APartIsNearTheWholeButTheWholeIsFarFromThePart) {
  TriangleMesh part = make_grid(4, 4, 0.25);
  part.triangles.resize(8);  // the lowest row
  const auto result = compare_to_truth(without_unused_vertices(part), make_grid(4, 4, 0.25));
  ASSERT_TRUE(result);
  EXPECT_LT(result->to_truth.max, 1e-12);
  // Above the row, distances are uniform from 0 to 0.75 on three quarters of the area.
  EXPECT_NEAR(result->from_truth.max, 0.75, 0.01);
  EXPECT_NEAR(result->from_truth.mean, 0.75 * 0.375, 0.001);
  EXPECT_NEAR(result->from_truth.p95, 0.7, 0.001);
  EXPECT_EQ(result->hausdorff(), result->from_truth.max);
}

TEST(CompareToTruth, AFoldedSurfaceHasTheWrongNormals) {
  TriangleMesh mesh = make_grid(2, 2);
  const TriangleMesh truth = mesh;
  for (Triangle& t : mesh.triangles) std::swap(t[0], t[1]);
  EXPECT_NEAR(compare_to_truth(mesh, truth)->mean_normal_error, std::numbers::pi, 1e-9);
}

TEST(CompareToTruth, FramesAreTakenIntoAccount) {
  TriangleMesh mesh = make_box();
  const TriangleMesh truth = mesh;
  mesh.frame.origin = {1000, 0, 0};
  for (Vec3f& p : mesh.positions) p.x -= 1000;
  EXPECT_LT(compare_to_truth(mesh, truth, {.samples = 100})->hausdorff(), 1e-12);
}

TEST(CompareToTruth, OfACloudLeavesOutMissingPixels) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  PointCloud cloud;
  cloud.positions = {{0.5f, 0.5f, 3}, {kNan, kNan, kNan}, {0.25f, 0.5f, -4}};
  cloud.grid = GridSize{3, 1};
  const auto distances = compare_to_truth(cloud, make_grid(1, 1));
  ASSERT_TRUE(distances);
  EXPECT_EQ(distances->count, 2u);
  EXPECT_DOUBLE_EQ(distances->rms, std::sqrt(12.5));
  EXPECT_EQ(distances->max, 4);
}

TEST(CompareToTruth, SurfacesWithoutAreaAreRefused) {
  const TriangleMesh box = make_box();
  for (const auto& result :
       {compare_to_truth(TriangleMesh{}, box), compare_to_truth(box, TriangleMesh{})}) {
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::bad_geometry);
  }
  EXPECT_EQ(compare_to_truth(box, TriangleMesh{}).error().where, "truth");
  EXPECT_EQ(compare_to_truth(box, box, {.samples = 0}).error().code, ErrorCode::invalid_argument);
}

TEST(CompareToTruth, IsTheSameForAnyNumberOfThreads) {
  const TriangleMesh mesh = make_torus(1, 0.4, 30, 20), truth = make_torus(1, 0.41, 31, 23);
  Context one, three;
  one.threads = 1, three.threads = 3;
  const auto a = compare_to_truth(mesh, truth, {.samples = 5000}, one);
  const auto b = compare_to_truth(mesh, truth, {.samples = 5000}, three);
  const Facts of_a = a->facts(), of_b = b->facts();
  ASSERT_EQ(of_a.size(), of_b.size());
  for (std::size_t i = 0; i < of_a.size(); ++i) EXPECT_EQ(of_a[i].value, of_b[i].value);
}

}  // namespace
}  // namespace burnish
