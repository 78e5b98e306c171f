#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "burnish/shapes/shapes.h"
#include "burnish/smoothing/gaussian.h"
#include "burnish/smoothing/laplacian.h"
#include "burnish/smoothing/nearest_farthest.h"
#include "burnish/smoothing/one_ring_mean.h"
#include "support/random_mesh.h"

namespace burnish {
namespace {

TEST(Sigma, OfOnePassIsThatOfAWeightedMeanOfIndependentErrors) {
  TriangleMesh mesh = make_grid(2, 2);  // vertex 4 has six neighbours: all but 2 and 6
  mesh.attributes.sigma = {1, 2, 9, 3, 4, 5, 9, 6, 7};
  ASSERT_TRUE(smooth_one_ring_mean(mesh));
  const double squares = 1 + 4 + 9 + 16 + 25 + 36 + 49;
  EXPECT_FLOAT_EQ(mesh.attributes.sigma[4], static_cast<float>(std::sqrt(squares) / 7));
  EXPECT_EQ(mesh.attributes.sigma[0], 1.f);  // the boundary stays, and what is known of it
}

/// How large what is left of errors along the normals typically is, divided by what sigma says: the
/// median over that of a normal distribution, because under Eq. 1 errors now and then exchange who
/// is nearest. The mesh is irregular, so that this is rare.
template <class Smooth>
double error_per_sigma(Smooth smooth) {
  const double sigma = 1e-5;
  TriangleMesh clean = test::with_noise(make_torus(1, 0.5, 96, 48), 0.01, 99);
  clean.attributes.sigma.assign(clean.positions.size(), static_cast<float>(sigma));
  const std::vector<Vec3f> normals = vertex_normals(clean);
  TriangleMesh expected = clean;
  smooth(expected);
  std::vector<double> ratios;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    TriangleMesh noisy = clean;
    for (std::size_t v = 0; v < clean.positions.size(); ++v) {
      noisy.positions[v] += Vec3f(sigma * Random(seed, v).normal() * Vec3d(normals[v]));
    }
    smooth(noisy);
    for (std::size_t v = 0; v < noisy.positions.size(); ++v) {
      const double error =
          dot(Vec3d(noisy.positions[v]) - Vec3d(expected.positions[v]), Vec3d(normals[v]));
      ratios.push_back(std::abs(error) / noisy.attributes.sigma[v]);
    }
  }
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  return *middle / 0.6745;
}

TEST(Sigma, NeverPromisesMuchMoreThanIsKept) {
  for (const int iterations : {1, 2, 5, 20}) {
    SCOPED_TRACE(iterations);

    const double mean = error_per_sigma(
        [&](TriangleMesh& mesh) { ASSERT_TRUE(smooth_one_ring_mean(mesh, {iterations})); });
    EXPECT_LT(mean, 1.1);
    EXPECT_GT(mean, 0.7);
    const double gaussian = error_per_sigma(
        [&](TriangleMesh& mesh) { ASSERT_TRUE(smooth_gaussian(mesh, {iterations})); });
    EXPECT_LT(gaussian, 1.1);
    EXPECT_GT(gaussian, 0.7);
    const double nearest_farthest = error_per_sigma(
        [&](TriangleMesh& mesh) { ASSERT_TRUE(smooth_nearest_farthest(mesh, {iterations})); });
    EXPECT_LT(nearest_farthest, 1.1);
    EXPECT_GT(nearest_farthest, 0.7);
    for (const auto weights : {LaplacianWeights::uniform, LaplacianWeights::cotangent}) {
      const double laplacian = error_per_sigma([&](TriangleMesh& mesh) {
        ASSERT_TRUE(smooth_laplacian(mesh, {.weights = weights, .iterations = iterations}));
      });
      EXPECT_LT(laplacian, 1.1);
      EXPECT_GT(laplacian, 0.6);
    }
  }
}

}  // namespace
}  // namespace burnish
