#include "burnish/smoothing/humphrey.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "burnish/smoothing/one_ring_mean.h"
#include "support/plain_smoothing.h"

namespace burnish {
namespace {

/// The algorithm as the paper prints it, vertex by vertex; vertices without a ring are left out.
template <int iterations>
std::vector<Vec3d> plain_humphrey(const TriangleMesh& mesh, BoundaryRule rule) {
  const double alpha = 0.2, beta = 0.6;
  const test::PlainRings rings = test::plain_rings(mesh, rule);
  const std::vector<Vec3d> o = test::plain_positions(mesh);
  std::vector<Vec3d> p = o;
  for (int i = 0; i < iterations; ++i) {
    const std::vector<Vec3d> q = p;
    std::vector<Vec3d> b(p.size());
    for (std::size_t v = 0; v < p.size(); ++v) {
      p[v] = test::plain_mean(rings, q, v);
      b[v] = p[v] - (alpha * o[v] + (1 - alpha) * q[v]);
    }
    for (std::size_t v = 0; v < p.size(); ++v) {
      if (rings[v].empty()) continue;
      p[v] -= beta * b[v] + (1 - beta) * test::plain_mean(rings, b, v);
    }
  }
  return p;
}

template <int iterations>
auto smooth(TriangleMesh& mesh, BoundaryRule rule) {
  return smooth_humphrey(mesh,
                         {.alpha = 0.2, .beta = 0.6, .iterations = iterations, .boundary = rule});
}

TEST(Humphrey, IsAsThePapersFormula) {
  test::expect_as_plain_on_random_meshes(smooth<5>, plain_humphrey<5>);
}

TEST(Humphrey, IsAsThePapersFormulaOnTheBunny) {
  BURNISH_EXPECT_AS_PLAIN_ON_THE_BUNNY(smooth<3>, plain_humphrey<3>);
}

TEST(Humphrey, KeepsTheVolumeOfASphere) {
  // The positions are a wave of k = e^2 / (2 R^2), see the test of smooth_taubin; a pass multiplies
  // it by 1 - k^2 / 2, the volume by the cube. Edges differ by up to 20 % from the mean, their
  // fourth powers by up to 2.
  const TriangleMesh before = make_sphere(1, 4);
  const double volume = test::volume(before);
  const double edge = std::sqrt(4 * std::numbers::pi / 5120 * 4 / std::sqrt(3.));
  const double k = edge * edge / 2, loss = 3 * 10 * k * k / 2;
  TriangleMesh mesh = before;
  ASSERT_TRUE(smooth_humphrey(mesh));
  EXPECT_LT(std::abs(test::volume(mesh) / volume - 1), 2 * loss);
  TriangleMesh mean = before;
  ASSERT_TRUE(smooth_one_ring_mean(mean, {.iterations = 10}));
  EXPECT_LT(test::volume(mean) / volume - 1, -20 * loss);
}

TEST(Humphrey, TheOriginalPullsBack) {
  // With alpha = beta = 1 each vertex is pushed back all the way to where it was at first.
  TriangleMesh mesh = test::with_noise(make_sphere(1, 3), 0.02, 1);
  const TriangleMesh before = mesh;
  ASSERT_TRUE(smooth_humphrey(mesh, {.alpha = 1, .beta = 1, .iterations = 7}));
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    EXPECT_LT(norm(Vec3d(mesh.positions[v]) - Vec3d(before.positions[v])), 2e-7);
  }
}

}  // namespace
}  // namespace burnish
