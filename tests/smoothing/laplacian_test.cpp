#include "burnish/smoothing/laplacian.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/plain_smoothing.h"

namespace burnish {
namespace {

constexpr double kLambda = 0.7;

std::vector<Vec3d> plain_uniform(const TriangleMesh& mesh, BoundaryRule rule) {
  const test::PlainRings rings = test::plain_rings(mesh, rule);
  std::vector<Vec3d> p = test::plain_positions(mesh);
  for (int pass = 0; pass < 3; ++pass) {
    const std::vector<Vec3d> old = p;
    for (std::size_t v = 0; v < p.size(); ++v) {
      p[v] = old[v] + kLambda * (test::plain_mean(rings, old, v) - old[v]);
    }
  }
  return p;
}

/// By the angle itself, from the three lengths of the triangle.
double plain_cotangent(const Vec3d& at, const Vec3d& b, const Vec3d& c) {
  const double x = norm(b - at), y = norm(c - at);
  if (x == 0 || y == 0) return 0;
  const Vec3d u = (b - at) / x, v = (c - at) / y;
  const double angle = 2 * std::atan2(norm(u - v), norm(u + v));
  const double tangent = std::tan(angle);
  return std::abs(tangent) < 1e-3 ? std::copysign(1e3, std::cos(angle)) : 1 / tangent;
}

/// The whole matrix of weights is summed triangle by triangle, then every vertex is moved.
std::vector<Vec3d> plain_cotangents(const TriangleMesh& mesh, BoundaryRule rule) {
  const test::PlainRings rings = test::plain_rings(mesh, rule);
  const test::PlainRings all = test::plain_rings(mesh, BoundaryRule::free);
  const test::PlainRings inner = test::plain_rings(mesh, BoundaryRule::fixed);
  std::vector<Vec3d> p = test::plain_positions(mesh);
  for (int pass = 0; pass < 3; ++pass) {
    const std::vector<Vec3d> old = p;
    std::vector<std::map<std::uint32_t, double>> weights(p.size());
    for (const auto& [a, b, c] : mesh.triangles) {
      if (a == b || b == c || c == a) continue;
      for (const auto& [v, w, at] :
           {std::tuple{a, b, c}, std::tuple{b, c, a}, std::tuple{c, a, b}}) {
        const double cotangent = plain_cotangent(old[at], old[v], old[w]);
        weights[v][w] += cotangent;
        weights[w][v] += cotangent;
      }
    }
    for (std::uint32_t v = 0; v < p.size(); ++v) {
      const bool on_curve = rule == BoundaryRule::along_boundary && inner[v].empty();
      Vec3d sum;
      double total = 0;
      for (const std::uint32_t w : rings[v]) {
        const double weight = on_curve ? 1 : std::max(weights[v][w], 0.0);
        sum += weight * old[w];
        total += weight;
      }
      if (total > 0) p[v] = old[v] + kLambda * (sum / total - old[v]);
    }
  }
  return p;
}

template <LaplacianWeights weights>
auto smooth(TriangleMesh& mesh, BoundaryRule rule) {
  return smooth_laplacian(
      mesh, {.weights = weights, .lambda = kLambda, .iterations = 3, .boundary = rule});
}

TEST(Laplacian, WithEqualWeightsIsAsThePapersFormula) {
  test::expect_as_plain_on_random_meshes(smooth<LaplacianWeights::uniform>, plain_uniform);
}

TEST(Laplacian, WithEqualWeightsIsAsThePapersFormulaOnTheBunny) {
  BURNISH_EXPECT_AS_PLAIN_ON_THE_BUNNY(smooth<LaplacianWeights::uniform>, plain_uniform);
}

TEST(Laplacian, WithCotangentsIsAsThePapersFormula) {
  test::expect_as_plain_on_random_meshes(smooth<LaplacianWeights::cotangent>, plain_cotangents);
}

TEST(Laplacian, WithCotangentsIsAsThePapersFormulaOnTheBunny) {
  BURNISH_EXPECT_AS_PLAIN_ON_THE_BUNNY(smooth<LaplacianWeights::cotangent>, plain_cotangents);
}

TEST(Laplacian, WithCotangentsLeavesAPlaneHoweverItIsTriangulated) {
  // The cotangent Laplacian of linear functions is 0 wherever no weight is clamped: triangles with
  // three equal edges of 1, their corners moved by less than 0.1, have no angle of 90 degrees.
  TriangleMesh mesh = make_grid(20, 20);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    Random random(3, v);
    const double x = random.uniform(-0.07, 0.07) + mesh.positions[v].x - mesh.positions[v].y / 2;
    const double y = random.uniform(-0.07, 0.07) + mesh.positions[v].y * std::sqrt(0.75);
    mesh.positions[v] = Vec3f(Vec3d{x, y, 0.3 * x});
  }
  const TriangleMesh before = mesh;
  ASSERT_TRUE(smooth_laplacian(
      mesh, {.weights = LaplacianWeights::cotangent, .lambda = 1, .iterations = 5}));
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    EXPECT_LT(norm(Vec3d(mesh.positions[v]) - Vec3d(before.positions[v])), 2e-5);
  }
}

TEST(Laplacian, KeepsEveryVertexWithinTheBoxOfTheMesh) {
  // Both kinds of weights are convex, whatever the triangles are like.
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    TriangleMesh mesh = test::random_mesh(100, 200, seed);
    ASSERT_TRUE(smooth_laplacian(mesh, {.weights = LaplacianWeights::cotangent,
                                        .lambda = 1,
                                        .iterations = 50,
                                        .boundary = BoundaryRule::free}));
    for (const Vec3f& p : mesh.positions) {
      EXPECT_LE(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}), 1.f);
    }
  }
}

TEST(Laplacian, SurvivesTrianglesWithoutArea) {
  TriangleMesh mesh = make_grid(6, 6);
  for (Vec3f& p : mesh.positions) p.y = 0;  // all on a line, many on top of each other
  ASSERT_TRUE(smooth_laplacian(mesh, {.weights = LaplacianWeights::cotangent}));
  for (Vec3f& p : mesh.positions) p = {1, 2, 3};
  const TriangleMesh point = mesh;
  ASSERT_TRUE(smooth_laplacian(mesh, {.weights = LaplacianWeights::cotangent}));
  EXPECT_EQ(mesh, point);
}

}  // namespace
}  // namespace burnish
