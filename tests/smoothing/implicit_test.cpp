#include "burnish/smoothing/implicit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "burnish/core/edges.h"
#include "burnish/smoothing/smoothing_weights.h"
#include "support/plain_smoothing.h"

namespace burnish {
namespace {

constexpr double kLambda = 1.5;

/// By the angle itself, from the three lengths of the triangle; see cotangent.h for slivers.
double plain_cotangent(const Vec3d& at, const Vec3d& b, const Vec3d& c) {
  const double x = norm(b - at), y = norm(c - at);
  if (x == 0 || y == 0) return 0;
  const Vec3d u = (b - at) / x, v = (c - at) / y;
  const double tangent = std::tan(2 * std::atan2(norm(u - v), norm(u + v)));
  return std::abs(tangent) < 1e-3 ? (dot(u, v) > 0 ? 1e3 : -1e3) : 1 / tangent;
}

using Weights = std::vector<std::map<std::uint32_t, double>>;

/// Solves (M + t S) p' = M p for the vertices that are free, by successive over-relaxation.
void relax(std::vector<Vec3d>& p, const std::vector<double>& mass, const Weights& stiffness,
           const std::vector<bool>& free, double time) {
  const std::vector<Vec3d> old = p;
  std::vector<std::vector<std::pair<std::uint32_t, double>>> rows(p.size());
  for (std::size_t v = 0; v < p.size(); ++v)
    rows[v].assign(stiffness[v].begin(), stiffness[v].end());
  for (double change = 1; change > 1e-10;) {
    change = 0;
    for (std::size_t v = 0; v < p.size(); ++v) {
      if (!free[v]) continue;
      Vec3d sum = mass[v] * old[v];
      double total = mass[v];
      for (const auto& [w, weight] : rows[v]) {
        sum += time * weight * p[w];
        total += time * weight;
      }
      change = std::max(change, norm(sum / total - p[v]));
      p[v] += 1.8 * (sum / total - p[v]);
    }
  }
}

/// One step.
std::vector<Vec3d> plain_implicit(const TriangleMesh& mesh, BoundaryRule rule) {
  const test::PlainRings rings = test::plain_rings(mesh, rule);
  const test::PlainRings all = test::plain_rings(mesh, BoundaryRule::free);
  const test::PlainRings inner = test::plain_rings(mesh, BoundaryRule::fixed);
  const std::size_t count = mesh.positions.size();
  const std::vector<Vec3d> old = test::plain_positions(mesh);
  double length = 0, links = 0;
  for (std::uint32_t v = 0; v < count; ++v) {
    for (const std::uint32_t w : all[v]) length += norm(old[w] - old[v]), links += 1;
  }
  length /= links;
  const double time = kLambda * length * length;

  std::vector<bool> on_curve(count), on_surface(count);
  Weights curve(count), surface(count);
  std::vector<double> curve_mass(count), surface_mass(count);
  for (std::uint32_t v = 0; v < count; ++v) {
    on_curve[v] = rule == BoundaryRule::along_boundary && inner[v].empty() && !all[v].empty();
    on_surface[v] = !on_curve[v] && !rings[v].empty();
    for (const std::uint32_t w : rings[v]) {
      if (!on_curve[v]) continue;
      const double edge = std::max(norm(old[w] - old[v]), 1e-3 * length);
      curve[v][w] = 1 / edge;
      curve_mass[v] += edge / 2;
    }
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    if (a == b || b == c || c == a) continue;
    for (const auto& [v, w, at] : {std::tuple{a, b, c}, std::tuple{b, c, a}, std::tuple{c, a, b}}) {
      const double half = plain_cotangent(old[at], old[v], old[w]) / 2;
      surface[v][w] += half;
      surface[w][v] += half;
      surface_mass[v] += norm(cross(old[b] - old[a], old[c] - old[a])) / 6;
    }
  }
  for (std::uint32_t v = 0; v < count; ++v) {
    for (auto& [w, weight] : surface[v]) weight = std::max(weight, 0.0);
    surface_mass[v] = std::max(surface_mass[v], 1e-9 * length * length);
    curve_mass[v] = std::max(curve_mass[v], 1e-3 * length);
  }
  std::vector<Vec3d> p = old;
  relax(p, curve_mass, curve, on_curve, time);
  relax(p, surface_mass, surface, on_surface, time);
  return p;
}

auto smooth(TriangleMesh& mesh, BoundaryRule rule) {
  return smooth_implicit(mesh, {.lambda = kLambda, .volume = VolumePolicy::free, .boundary = rule});
}

TEST(Implicit, IsAsThePapersFormula) {
  test::expect_as_plain_on_random_meshes(smooth, plain_implicit);
}

TEST(Implicit, IsAsThePapersFormulaOnTheBunny) {
  BURNISH_EXPECT_AS_PLAIN_ON_THE_BUNNY(smooth, plain_implicit);
}

/// Two noisy spheres of different sizes, apart.
TriangleMesh two_spheres() {
  TriangleMesh mesh = test::with_noise(make_sphere(1, 3), 0.03, 1);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const TriangleMesh other = test::with_noise(make_sphere(0.3, 2), 0.02, 2);
  for (const Vec3f& p : other.positions) mesh.positions.push_back(p + Vec3f{2, 0, 0});
  for (const auto& [a, b, c] : other.triangles) {
    mesh.triangles.push_back({first + a, first + b, first + c});
  }
  return mesh;
}

/// The volumes of the two.
std::pair<double, double> volumes(const TriangleMesh& mesh) {
  TriangleMesh one = mesh, two = mesh;
  one.triangles.resize(1280);
  two.triangles.erase(two.triangles.begin(), two.triangles.begin() + 1280);
  return {test::volume(one), test::volume(two)};
}

TEST(Implicit, KeepsTheVolumeOfEveryClosedPart) {
  TriangleMesh kept = two_spheres(), free = kept;
  const auto [large, small] = volumes(kept);
  ASSERT_TRUE(smooth_implicit(kept, {.lambda = 5, .iterations = 3}));
  // Positions are floats below 4, 1.2e-7 wrong at random; the volume is an integral over them.
  EXPECT_NEAR(volumes(kept).first / large, 1, 1e-7);
  EXPECT_NEAR(volumes(kept).second / small, 1, 1e-6);
  ASSERT_TRUE(smooth_implicit(free, {.lambda = 5, .iterations = 3, .volume = VolumePolicy::free}));
  EXPECT_LT(volumes(free).first / large, 0.9);
  EXPECT_LT(volumes(free).second / small, 0.9);
}

TEST(Implicit, DoesNotScaleWhatIsHeldBack) {
  TriangleMesh mesh = two_spheres();
  std::vector<float> weights(mesh.positions.size(), 1);
  weights[5] = 0;  // of the larger sphere
  mesh.attributes.channels = {{std::string(kSmoothingWeight), weights}};
  const TriangleMesh before = mesh;
  ASSERT_TRUE(smooth_implicit(mesh));
  EXPECT_EQ(mesh.positions[5], before.positions[5]);
  EXPECT_LT(volumes(mesh).first / volumes(before).first, 1 - 1e-3);
  EXPECT_NEAR(volumes(mesh).second / volumes(before).second, 1, 1e-6);
}

TEST(Implicit, ShrinksASphereAsTheFlowDoes) {
  // The cotangent Laplacian of the positions is -2 / R times the normal, so that a backward step of
  // time t divides the radius by 1 + 2 t / R^2. Lumped areas are right on average: the radius of
  // each vertex within 10 % of what it loses.
  TriangleMesh mesh = make_sphere(1, 4);
  const double edge = mean_edge_length(mesh);
  const double loss = 1 - 1 / (1 + 2 * 3 * edge * edge);
  ASSERT_TRUE(smooth_implicit(mesh, {.lambda = 3, .volume = VolumePolicy::free}));
  for (const Vec3f& p : mesh.positions) EXPECT_NEAR(1 - norm(Vec3d(p)), loss, 0.1 * loss);
}

TEST(Implicit, AVertexOfLessWeightFlowsMoreSlowly) {
  TriangleMesh free = make_grid(2, 2), held = free, pinned = free;
  free.positions[4].z = held.positions[4].z = pinned.positions[4].z = 0.01f;
  held.attributes.channels = {{std::string(kSmoothingWeight), std::vector<float>(9, 0.25f)}};
  pinned.attributes.channels = {{std::string(kSmoothingWeight), std::vector<float>(9, 0.f)}};
  const TriangleMesh before = pinned;
  ASSERT_TRUE(smooth_implicit(free));
  ASSERT_TRUE(smooth_implicit(held));
  ASSERT_TRUE(smooth_implicit(pinned));
  // Of one vertex among fixed ones z / z' = 1 + w t s / m.
  const double drag = 0.01 / double{free.positions[4].z} - 1;
  EXPECT_NEAR(0.01 / double{held.positions[4].z} - 1, 0.25 * drag, 1e-5 * drag);
  EXPECT_EQ(pinned, before);
}

TEST(Implicit, SurvivesTrianglesWithoutArea) {
  for (const BoundaryRule rule :
       {BoundaryRule::fixed, BoundaryRule::along_boundary, BoundaryRule::free}) {
    TriangleMesh mesh = make_grid(6, 6);
    for (Vec3f& p : mesh.positions) p.y = 0;  // all on a line, many on top of each other
    ASSERT_TRUE(smooth_implicit(mesh, {.iterations = 3, .boundary = rule}));
    EXPECT_TRUE(check(mesh));
    for (Vec3f& p : mesh.positions) p = {1, 2, 3};
    const TriangleMesh point = mesh;
    ASSERT_TRUE(smooth_implicit(mesh, {.boundary = rule}));
    EXPECT_EQ(mesh, point);
  }
}

}  // namespace
}  // namespace burnish
