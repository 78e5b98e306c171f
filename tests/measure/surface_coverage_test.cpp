#include "burnish/measure/surface_coverage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "burnish/base/random.h"
#include "burnish/shapes/shapes.h"
#include "burnish/spatial/closest_point.h"

namespace burnish {
namespace {

constexpr int kSide = 10;

/// A grid of 10 x 10 cells of 1 m, in the middle of which 4 x 4 cells are missing.
TriangleMesh grid_with_a_hole() {
  TriangleMesh grid = make_grid(kSide, kSide);
  std::vector<std::uint32_t> kept;
  for (std::uint32_t t = 0; t < grid.triangles.size(); ++t) {
    const std::uint32_t cell = t / 2, column = cell % kSide, row = cell / kSide;
    if (column < 3 || column > 6 || row < 3 || row > 6) kept.push_back(t);
  }
  keep_triangles(grid, kept);
  return grid;
}

/// One triangle in the unit box around the origin.
TriangleMesh triangle(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  return {{a, b, c}, {{0, 1, 2}}, {}, {}};
}

TEST(SurfaceCoverage, OfASurfaceByItselfIsWhole) {
  const TriangleMesh sphere = make_sphere(1, 3);
  const auto coverage = surface_coverage(sphere, sphere, {.samples = 10000});
  ASSERT_TRUE(coverage);
  EXPECT_EQ(coverage->missing_share, 0);
  EXPECT_EQ(coverage->far_triangles, 0u);
  EXPECT_LT(coverage->farthest_triangle_distance, 1e-12);
  // 10 * 4^3 + 2 vertices on a surface of nearly 4 pi.
  EXPECT_NEAR(coverage->spacing, std::sqrt(4 * 3.14159 / 642), 0.001);
}

TEST(SurfaceCoverage, TheMiddleOfAHoleIsMissing) {
  // Of the hole of 4 x 4 the inner 2 x 2 are farther than 1 from its rim, of 10 x 10 in all. What
  // 400 samples of 10000 scatter by is at most their root.
  const CoverageParams params{.spacing = 1, .samples = 10000};
  const auto coverage = surface_coverage(grid_with_a_hole(), make_grid(kSide, kSide), params);
  ASSERT_TRUE(coverage);
  EXPECT_NEAR(coverage->true_area, 100, 1e-9);
  EXPECT_NEAR(coverage->missing_share, 0.04, 0.002);
  EXPECT_NEAR(coverage->missing_area, 4, 0.2);
  EXPECT_LT(coverage->farthest_triangle_distance, 1e-12);
}

TEST(SurfaceCoverage, ANarrowerToleranceSeesMoreOfTheHole) {
  // All of the hole but a rim of 0.5: 3 x 3.
  const CoverageParams params{.spacing = 1, .tolerance = 0.5, .samples = 10000};
  const auto coverage = surface_coverage(grid_with_a_hole(), make_grid(kSide, kSide), params);
  EXPECT_NEAR(coverage->missing_share, 0.09, 0.003);
}

TEST(SurfaceCoverage, SpacingCountsTheVerticesThatAreUsed) {
  // 11 x 11 vertices less the 3 x 3 inside the hole.
  const auto coverage = surface_coverage(grid_with_a_hole(), make_grid(kSide, kSide));
  EXPECT_DOUBLE_EQ(coverage->spacing, std::sqrt(100.0 / 112));
}

TEST(SurfaceCoverage, ATriangleIsAsFarAsTheFarthestOfItsPoints) {
  const TriangleMesh box = make_box();
  const auto farthest = [&](const TriangleMesh& mesh) {
    return surface_coverage(mesh, box, {.spacing = 0.1, .samples = 100})
        ->farthest_triangle_distance;
  };
  // A corner: one that stands 0.25 above the middle of the upper face.
  EXPECT_NEAR(farthest(triangle({-0.1f, 0, 0.5f}, {0.1f, 0, 0.5f}, {0, 0, 0.75f})), 0.25, 1e-9);
  // The middle of an edge: the box's diagonal has its middle half an edge from every face.
  EXPECT_NEAR(farthest(triangle({-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}, {0.5f, 0.5f, -0.5f})),
              0.5, 1e-9);
  // The centroid: three diagonals of faces cut a corner off; its middle is 1/3 from every face.
  EXPECT_NEAR(farthest(triangle({-0.5f, 0.5f, 0.5f}, {0.5f, -0.5f, 0.5f}, {0.5f, 0.5f, -0.5f})),
              1.0 / 3, 1e-7);
}

TEST(SurfaceCoverage, CountsAndNamesTheTrianglesFarAway) {
  TriangleMesh mesh = make_grid(kSide, kSide);
  const TriangleMesh truth = mesh;
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const float height : {1.5f, 2.5f, 3.5f}) {
    mesh.positions.push_back({5, 5, height});
    const auto apex = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    mesh.triangles.push_back({0, 1, apex});
  }
  const auto coverage = surface_coverage(mesh, truth, {.spacing = 1, .samples = 100});
  ASSERT_TRUE(coverage);
  EXPECT_EQ(coverage->far_triangles, 2u);
  EXPECT_EQ(mesh.triangles[coverage->farthest_triangle][2], first + 2);
  EXPECT_EQ(coverage->farthest_triangle_distance, 3.5);
  EXPECT_EQ(coverage->farthest_in_spacings(), 3.5);
  EXPECT_EQ(
      surface_coverage(mesh, truth, {.spacing = 1, .far_away = 3, .samples = 100})->far_triangles,
      1u);
}

TEST(SurfaceCoverage, IsAsDefinedOnARoughSurface) {
  TriangleMesh mesh = make_sphere(1, 2);  // its triangles' middles lie 0.02 deep
  const TriangleMesh truth = make_sphere(1, 4);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    mesh.positions[v] *= static_cast<float>(1 + 0.01 * Random(1, v).normal());
  }
  const ClosestPoint on_truth(truth);
  const double limit = 0.02;
  double farthest = 0;
  std::size_t far = 0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3d a(mesh.positions[i]), b(mesh.positions[j]), c(mesh.positions[k]);
    double most = 0;
    for (const Vec3d& p :
         {a, b, c, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a), (1.0 / 3) * (a + b + c)}) {
      most = std::max(most, on_truth(p).distance);
    }
    far += most > limit;
    farthest = std::max(farthest, most);
  }
  const CoverageParams params{.spacing = limit / 2, .samples = 100};
  const auto coverage = surface_coverage(mesh, truth, params);
  EXPECT_EQ(coverage->far_triangles, far);
  EXPECT_NEAR(coverage->farthest_triangle_distance, farthest, 1e-12);
}

TEST(SurfaceCoverage, FramesAreTakenIntoAccount) {
  TriangleMesh mesh = make_grid(kSide, kSide);
  const TriangleMesh truth = mesh;
  mesh.frame.origin = {1000, 0, 0};
  for (Vec3f& p : mesh.positions) p.x -= 1000;
  const auto coverage = surface_coverage(mesh, truth, {.samples = 1000});
  EXPECT_EQ(coverage->missing_share, 0);
  EXPECT_LT(coverage->farthest_triangle_distance, 1e-12);
}

TEST(SurfaceCoverage, RefusesWhatItCannotMeasure) {
  const TriangleMesh grid = make_grid(2, 2);
  EXPECT_EQ(surface_coverage({}, grid).error().where, "mesh");
  EXPECT_EQ(surface_coverage(grid, {}).error().where, "truth");
  for (const CoverageParams& params :
       {CoverageParams{.spacing = -1}, CoverageParams{.spacing = NAN},
        CoverageParams{.tolerance = 0}, CoverageParams{.far_away = INFINITY},
        CoverageParams{.samples = 0}}) {
    const auto refused = surface_coverage(grid, grid, params);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::invalid_argument);
  }
}

TEST(SurfaceCoverage, StopsWhereItIsCancelled) {
  Context context;
  std::stop_source source;
  context.stop = source.get_token();
  source.request_stop();
  EXPECT_EQ(surface_coverage(make_grid(2, 2), make_grid(2, 2), {}, context).error().code,
            ErrorCode::cancelled);
}

}  // namespace
}  // namespace burnish
