#include "burnish/smoothing/equalize.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/plain_smoothing.h"

namespace burnish {
namespace {

constexpr double kStep = 0.35;

/// The formula of the header.
std::vector<Vec3d> plain_equalize(const TriangleMesh& mesh, BoundaryRule rule) {
  const test::PlainRings rings = test::plain_rings(mesh, rule);
  const test::PlainRings inner = test::plain_rings(mesh, BoundaryRule::fixed);
  std::vector<Vec3d> p = test::plain_positions(mesh);
  for (int pass = 0; pass < 3; ++pass) {
    const std::vector<Vec3d> old = p;
    std::vector<Vec3d> normals(p.size());
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vec3d area = cross(old[b] - old[a], old[c] - old[a]);
      for (const std::uint32_t v : std::set<std::uint32_t>{a, b, c}) normals[v] += area;
    }
    for (std::size_t v = 0; v < p.size(); ++v) {
      Vec3d d;
      double total = 0;
      for (const std::uint32_t w : rings[v]) {
        d += norm(old[w] - old[v]) * (old[w] - old[v]);
        total += norm(old[w] - old[v]);
      }
      if (total == 0) continue;
      d *= kStep / total;
      if (rule == BoundaryRule::along_boundary && inner[v].empty()) {
        if (rings[v].size() != 2) continue;
        const Vec3d t = old[*rings[v].rbegin()] - old[*rings[v].begin()];
        p[v] += t * (dot(t, d) / dot(t, t));
      } else if (const Vec3d& n = normals[v]; dot(n, n) > 0) {
        p[v] += d - n * (dot(n, d) / dot(n, n));
      }
    }
  }
  return p;
}

auto smooth(TriangleMesh& mesh, BoundaryRule rule) {
  return smooth_equalize(mesh, {.step = kStep, .iterations = 3, .boundary = rule});
}

TEST(Equalize, IsAsItsFormula) {
  test::expect_as_plain_on_random_meshes(smooth, plain_equalize);
}

TEST(Equalize, IsAsItsFormulaOnTheBunny) {
  BURNISH_EXPECT_AS_PLAIN_ON_THE_BUNNY(smooth, plain_equalize);
}

/// A sphere whose vertices are unevenly spread: moved along it at random.
TriangleMesh uneven_sphere() {
  TriangleMesh mesh = test::with_noise(make_sphere(1, 4), 0.012, 5);
  for (Vec3f& p : mesh.positions) p = Vec3f(normalized(Vec3d(p)));
  return mesh;
}

TEST(Equalize, MovesNoVertexAlongItsNormal) {
  const TriangleMesh before = test::with_noise(make_sphere(1, 4), 0.012, 5);
  const std::vector<Vec3f> normals = vertex_normals(before);
  TriangleMesh mesh = before;
  const auto report = smooth_equalize(mesh, {.iterations = 1});
  ASSERT_TRUE(report);
  EXPECT_GT(report->rms_move, 1e-3);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3d move = Vec3d(mesh.positions[v]) - Vec3d(before.positions[v]);
    // The normal is a float, 1e-7 wrong against a move of at most an edge, and so are positions.
    EXPECT_LT(std::abs(dot(move, Vec3d(normals[v]))), 3e-7);
  }
}

/// The mean over the vertices of the spread of their neighbours' distances over the mean of these.
double unevenness(const TriangleMesh& mesh) {
  const test::PlainRings rings = test::plain_rings(mesh, BoundaryRule::free);
  double sum = 0;
  for (std::size_t v = 0; v < rings.size(); ++v) {
    double first = 0, second = 0;
    for (const std::uint32_t w : rings[v]) {
      const double d = norm(Vec3d(mesh.positions[w]) - Vec3d(mesh.positions[v]));
      first += d, second += d * d;
    }
    const auto n = static_cast<double>(rings[v].size());
    sum += std::sqrt(std::max(0.0, second / n - first / n * first / n)) / (first / n);
  }
  return sum / static_cast<double>(rings.size());
}

TEST(Equalize, EvensTheDistancesToNeighboursAndKeepsTheVolume) {
  const TriangleMesh before = uneven_sphere();
  TriangleMesh mesh = before;
  double last = unevenness(mesh);
  EXPECT_GT(last, 0.15);
  for (int pass = 0; pass < 5; ++pass) {
    ASSERT_TRUE(smooth_equalize(mesh, {.iterations = 1}));
    const double now = unevenness(mesh);
    EXPECT_LT(now, last);
    last = now;
  }
  EXPECT_LT(last, 0.05);
  // A vertex that moves by m in its tangent plane is m^2 / (2 R) farther out, and the volume grows
  // by three times the mean of that; as much again for how the polyhedron fills the sphere.
  double rise = 0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    rise += squared_norm(Vec3d(mesh.positions[v]) - Vec3d(before.positions[v])) / 2;
  }
  rise /= static_cast<double>(mesh.positions.size());
  EXPECT_NEAR(test::volume(mesh) / test::volume(before) - 1, 0, 6 * rise);
}

TEST(Equalize, LeavesVerticesThatAreEvenlySpread) {
  TriangleMesh mesh = make_grid(10, 10, 0.1);  // of floats near 1, 6e-8 wrong
  const TriangleMesh before = mesh;
  ASSERT_TRUE(smooth_equalize(mesh));
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    EXPECT_LT(norm(Vec3d(mesh.positions[v]) - Vec3d(before.positions[v])), 3e-7);
  }
}

}  // namespace
}  // namespace burnish
