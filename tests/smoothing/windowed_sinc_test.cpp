#include "burnish/smoothing/windowed_sinc.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/plain_smoothing.h"

namespace burnish {
namespace {

using std::numbers::pi;

/// The transfer function as the paper writes it, by the angle of its frequency.
double plain_transfer(int degree, double theta, double angle) {
  double sum = theta / pi;
  for (int n = 1; n <= degree; ++n) {
    sum += (0.54 + 0.46 * std::cos(n * pi / (degree + 1))) * 2 * std::sin(n * theta) / (n * pi) *
           std::cos(n * angle);
  }
  return sum;
}

/// f(x) / f(0) as a polynomial in x = 1 - k / 2: its coefficients, the lowest first.
std::vector<double> plain_polynomial(int degree, double pass_band) {
  const double edge = std::acos(1 - pass_band / 2);
  double theta = edge;
  while (plain_transfer(degree, theta, edge) < 1) theta += 1e-6;
  std::vector<double> t0{1}, t1{0, 1}, sum{theta / pi};
  sum.resize(static_cast<std::size_t>(degree) + 1);
  for (int n = 1; n <= degree; ++n) {
    for (std::size_t i = 0; i < t1.size(); ++i) {
      sum[i] += (0.54 + 0.46 * std::cos(n * pi / (degree + 1))) * 2 * std::sin(n * theta) /
                (n * pi) * t1[i];
    }
    std::vector<double> t2(t1.size() + 1);
    for (std::size_t i = 0; i < t1.size(); ++i) t2[i + 1] += 2 * t1[i];
    for (std::size_t i = 0; i < t0.size(); ++i) t2[i] -= t0[i];
    t0 = t1;
    t1 = t2;
  }
  for (double& c : sum) c /= plain_transfer(degree, theta, 0);
  return sum;
}

/// The polynomial's value at the matrix I - K / 2, by Horner's rule.
template <int degree>
std::vector<Vec3d> plain_windowed_sinc(const TriangleMesh& mesh, BoundaryRule rule) {
  const test::PlainRings rings = test::plain_rings(mesh, rule);
  const std::vector<double> polynomial = plain_polynomial(degree, 0.1);
  const std::vector<Vec3d> p = test::plain_positions(mesh);
  std::vector<Vec3d> value(p.size());
  for (std::size_t i = polynomial.size(); i-- > 0;) {
    const std::vector<Vec3d> old = value;
    for (std::size_t v = 0; v < p.size(); ++v) {
      value[v] = polynomial[i] * p[v] + (old[v] + test::plain_mean(rings, old, v)) / 2.;
    }
  }
  return value;
}

template <int degree>
auto smooth(TriangleMesh& mesh, BoundaryRule rule) {
  return smooth_windowed_sinc(mesh, {.iterations = degree, .boundary = rule});
}

TEST(WindowedSinc, IsAsThePapersFormula) {
  test::expect_as_plain_on_random_meshes(smooth<20>, plain_windowed_sinc<20>);
}

TEST(WindowedSinc, IsAsThePapersFormulaOnTheBunny) {
  BURNISH_EXPECT_AS_PLAIN_ON_THE_BUNNY(smooth<10>, plain_windowed_sinc<10>);
}

/// What is left of the height of waves along a boundary loop of 120 vertices; their frequencies
/// are 1 - cos(2 pi wave / 120).
double kept(std::uint32_t wave, const WindowedSincParams& params) {
  TriangleMesh mesh = test::disc_with_wave(120, wave);
  WindowedSincParams along = params;
  along.boundary = BoundaryRule::along_boundary;
  EXPECT_TRUE(smooth_windowed_sinc(mesh, along));
  return mesh.positions[0].z / 0.1;
}

TEST(WindowedSinc, LeavesWhatIsBelowThePassBandAndCutsOffWhatIsAbove) {
  // A Hamming window ripples by 0.2 %, and cuts off within 8 pi / (2 N + 1) of the angle
  // acos(1 - k / 2): for N = 40 from 0.317 (k = 0.1) to 0.63 (k = 0.38).
  const WindowedSincParams params{.iterations = 40, .pass_band = 0.1};
  for (const std::uint32_t wave : {1u, 4u, 8u}) EXPECT_NEAR(kept(wave, params), 1, 0.005) << wave;
  for (const std::uint32_t wave : {18u, 30u, 45u, 60u}) {
    EXPECT_NEAR(kept(wave, params), 0, 0.005) << wave;
  }
}

TEST(WindowedSinc, MovesAMeshThatIsElsewhereInTheSameWay) {
  // Without the division by f(0) a mesh a thousand diagonals away would move by two of them. Floats
  // there are 1e-4 apart.
  TriangleMesh near = test::with_noise(make_sphere(0.5, 3), 0.02, 1), far = near;
  for (Vec3f& p : far.positions) p.x += 1000;
  TriangleMesh there = far;
  for (std::size_t v = 0; v < near.positions.size(); ++v) {
    near.positions[v].x = far.positions[v].x - 1000;
  }
  ASSERT_TRUE(smooth_windowed_sinc(near));
  ASSERT_TRUE(smooth_windowed_sinc(there));
  for (std::size_t v = 0; v < near.positions.size(); ++v) {
    EXPECT_NEAR(there.positions[v].x - 1000, near.positions[v].x, 1e-4);
  }
}

TEST(WindowedSinc, APassBandThatIsTooWideForTheDegreeLeavesTheMesh) {
  TriangleMesh mesh = test::with_noise(make_sphere(1, 3), 0.02, 1);
  const TriangleMesh before = mesh;
  ASSERT_TRUE(smooth_windowed_sinc(mesh, {.iterations = 2, .pass_band = 2}));
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    EXPECT_LT(norm(Vec3d(mesh.positions[v]) - Vec3d(before.positions[v])), 1e-6);
  }
}

}  // namespace
}  // namespace burnish
