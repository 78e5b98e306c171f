#include "burnish/smoothing/gaussian.h"

#include <gtest/gtest.h>

#include <cmath>

#include "burnish/core/edges.h"
#include "burnish/shapes/shapes.h"
#include "burnish/smoothing/one_ring_mean.h"
#include "support/random_mesh.h"

namespace burnish {
namespace {

TEST(Gaussian, WeighsNeighboursByTheirDistance) {
  TriangleMesh mesh = make_grid(2, 2);  // vertex 4 in the middle
  mesh.positions[4] = {1.25f, 1, 0.5f};
  const TriangleMesh before = mesh;
  const double s = 0.7 * mean_edge_length(mesh);
  ASSERT_TRUE(smooth_gaussian(mesh, {.relative_width = 0.7}));
  Vec3d sum(before.positions[4]);
  double weights = 1;
  for (const std::size_t j : {0, 1, 3, 5, 7, 8}) {
    const Vec3d d = Vec3d(before.positions[j]) - Vec3d(before.positions[4]);
    const double w = std::exp(-dot(d, d) / (2 * s * s));
    sum += w * Vec3d(before.positions[j]);
    weights += w;
  }
  EXPECT_LT(norm(Vec3d(mesh.positions[4]) - sum / weights), 2e-7);
}

TEST(Gaussian, OfGreatWidthIsTheOneRingMean) {
  const TriangleMesh before = test::with_noise(make_sphere(1, 3), 0.02, 1);
  TriangleMesh wide = before, mean = before;
  ASSERT_TRUE(smooth_gaussian(wide, {.iterations = 3, .relative_width = 1000}));
  ASSERT_TRUE(smooth_one_ring_mean(mean, {.iterations = 3}));
  for (std::size_t v = 0; v < before.positions.size(); ++v) {
    EXPECT_LT(norm(Vec3d(wide.positions[v]) - Vec3d(mean.positions[v])), 1e-6);
  }
}

TEST(Gaussian, AMeshWithoutExtentStays) {
  TriangleMesh mesh = make_grid(2, 2);
  for (Vec3f& p : mesh.positions) p = {1, 2, 3};
  const TriangleMesh before = mesh;
  ASSERT_TRUE(smooth_gaussian(mesh));
  EXPECT_EQ(mesh, before);
}

}  // namespace
}  // namespace burnish
