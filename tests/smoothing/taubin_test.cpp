#include "burnish/smoothing/taubin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "burnish/smoothing/laplacian.h"
#include "support/plain_smoothing.h"

namespace burnish {
namespace {

std::vector<Vec3d> plain_taubin(const TriangleMesh& mesh, BoundaryRule rule) {
  const test::PlainRings rings = test::plain_rings(mesh, rule);
  std::vector<Vec3d> p = test::plain_positions(mesh);
  for (int iteration = 0; iteration < 10; ++iteration) {
    for (const double step : {0.5, -0.53}) {
      std::vector<Vec3d> umbrella(p.size());
      for (std::size_t v = 0; v < p.size(); ++v) {
        umbrella[v] = test::plain_mean(rings, p, v) - p[v];
      }
      for (std::size_t v = 0; v < p.size(); ++v) p[v] += step * umbrella[v];
    }
  }
  return p;
}

auto smooth(TriangleMesh& mesh, BoundaryRule rule) {
  return smooth_taubin(mesh, {.boundary = rule});
}

TEST(Taubin, IsAsThePapersFormula) {
  test::expect_as_plain_on_random_meshes(smooth, plain_taubin);
}

TEST(Taubin, IsAsThePapersFormulaOnTheBunny) {
  BURNISH_EXPECT_AS_PLAIN_ON_THE_BUNNY(smooth, plain_taubin);
}

TEST(Taubin, MultipliesEachWaveByItsTransferFunction) {
  constexpr std::uint32_t n = 60;
  const double lambda = 0.6, mu = -0.65;
  for (const std::uint32_t wave : {1u, 3u, 10u, 20u, 30u}) {
    TriangleMesh mesh = test::disc_with_wave(n, wave);
    ASSERT_TRUE(smooth_taubin(
        mesh,
        {.lambda = lambda, .mu = mu, .iterations = 4, .boundary = BoundaryRule::along_boundary}));
    const double k = 1 - std::cos(2 * std::numbers::pi * wave / n);
    const double kept = std::pow((1 - lambda * k) * (1 - mu * k), 4);
    for (std::uint32_t i = 0; i < n; ++i) {
      const double expected = 0.1 * std::cos(wave * 2 * std::numbers::pi * i / n) * kept;
      EXPECT_NEAR(mesh.positions[i].z, expected, 1e-7);
    }
  }
}

TEST(Taubin, APassBandStandsForMu) {
  const TriangleMesh before = test::with_noise(make_sphere(1, 3), 0.02, 1);
  TriangleMesh by_mu = before, by_band = before;
  ASSERT_TRUE(smooth_taubin(by_mu, {.lambda = 0.5, .mu = -0.53}));
  ASSERT_TRUE(smooth_taubin(by_band, {.lambda = 0.5, .mu = -1, .pass_band = 2 - 1 / 0.53}));
  EXPECT_EQ(by_mu.positions, by_band.positions);
}

TEST(Taubin, KeepsTheVolumeOfASphere) {
  // The mean of a ring of edges e lies e^2 / (2 R) below its vertex: the positions are a wave of
  // k = e^2 / (2 R^2). An iteration multiplies it by 1 - (lambda + mu) k - ..., the volume by the
  // cube of that. The mean of e^2 over the rings is that of the whole within 5 %; terms of second
  // order are below 1 % of the first.
  TriangleMesh mesh = make_sphere(1, 4);
  const double edge = std::sqrt(4 * std::numbers::pi / 5120 * 4 / std::sqrt(3.));
  const double k = edge * edge / 2, growth = 3 * 10 * 0.03 * k;
  const double before = test::volume(mesh);
  ASSERT_TRUE(smooth_taubin(mesh));
  EXPECT_NEAR(test::volume(mesh) / before - 1, growth, 0.06 * growth);
  TriangleMesh shrunk = make_sphere(1, 4);
  ASSERT_TRUE(smooth_laplacian(shrunk, {.lambda = 0.5, .iterations = 20}));
  EXPECT_LT(test::volume(shrunk) / before - 1, -10 * growth);
}

TEST(Taubin, RefusesToReturnWhatHasGrownBeyondNumbers) {
  TriangleMesh mesh = test::with_noise(make_grid(10, 10), 0.1, 1);
  const TriangleMesh before = mesh;
  const auto report = smooth_taubin(mesh, {.lambda = 1, .mu = -2, .iterations = 1000});
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::invalid_argument);
  EXPECT_EQ(mesh, before);
}

TEST(Taubin, LeavesSigma) {
  TriangleMesh mesh = test::with_noise(make_sphere(1, 2), 0.02, 1);
  mesh.attributes.sigma.assign(mesh.positions.size(), 0.02f);
  const std::vector<float> before = mesh.attributes.sigma;
  ASSERT_TRUE(smooth_taubin(mesh));
  EXPECT_EQ(mesh.attributes.sigma, before);
}

}  // namespace
}  // namespace burnish
