#include "burnish/smoothing/nearest_farthest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "burnish/core/adjacency.h"
#include "burnish/shapes/shapes.h"
#include "burnish/shapes/teapot.h"
#include "support/bunny.h"
#include "support/random_mesh.h"
#include "support/test_data.h"

namespace burnish {
namespace {

using test::random_mesh;
using test::with_noise;

/// Eq. 1 as it stands, in double, from plain sets; exact ties share the weight.
std::vector<Vec3d> plain_equation_1(const std::vector<Triangle>& triangles,
                                    const std::vector<Vec3d>& old) {
  std::vector<std::set<std::uint32_t>> rings(old.size());
  for (const auto& [a, b, c] : triangles) {
    rings[a].insert({b, c});
    rings[b].insert({a, c});
    rings[c].insert({a, b});
  }
  std::vector<Vec3d> moved = old;
  for (std::uint32_t i = 0; i < old.size(); ++i) {
    rings[i].erase(i);
    if (rings[i].empty()) continue;
    double least = 1e300, greatest = -1;
    Vec3d sum;
    for (const std::uint32_t j : rings[i]) {
      const double d = norm(old[j] - old[i]);
      least = std::min(least, d);
      greatest = std::max(greatest, d);
      sum += old[j];
    }
    Vec3d nearest, farthest;
    double near_count = 0, far_count = 0;
    for (const std::uint32_t j : rings[i]) {
      const double d = norm(old[j] - old[i]);
      if (d == least) nearest += old[j], ++near_count;
      if (d == greatest) farthest += old[j], ++far_count;
    }
    moved[i] = (sum + nearest / near_count + farthest / far_count) /
               static_cast<double>(rings[i].size() + 2);
  }
  return moved;
}

std::vector<Vec3d> in_double(const std::vector<Vec3f>& positions) {
  std::vector<Vec3d> result;
  for (const Vec3f& p : positions) result.push_back(Vec3d(p));
  return result;
}

double largest_difference(const std::vector<Vec3f>& ours, const std::vector<Vec3d>& expected) {
  double largest = 0;
  for (std::size_t v = 0; v < ours.size(); ++v) {
    largest = std::max(largest, norm(Vec3d(ours[v]) - expected[v]));
  }
  return largest;
}

TEST(NearestFarthest, EqualsAPlainEvaluationOnTheBunny) {
  BURNISH_DATA_OR_SKIP(path, "stanford/bun_zipper.ply");
  const TriangleMesh bunny = test::read_bunny(path);
  ASSERT_EQ(bunny.triangles.size(), 69451u);
  std::vector<Vec3d> expected = in_double(bunny.positions);
  for (int passes = 0; passes < 10; ++passes) {
    expected = plain_equation_1(bunny.triangles, expected);
    if (passes != 0 && passes != 9) continue;
    TriangleMesh mesh = bunny;
    ASSERT_TRUE(
        smooth_nearest_farthest(mesh, {.iterations = passes + 1, .boundary = BoundaryRule::free}));
    // Its diagonal is 0.25 m.
    EXPECT_LT(largest_difference(mesh.positions, expected), 1e-6 * 0.25) << passes + 1;
  }
}

TEST(NearestFarthest, EqualsAPlainEvaluationOnAnyMesh) {
  const float rounding = 0x1p-24f;  // of coordinates up to 1
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    for (const TriangleMesh& before : {random_mesh(30, 40, seed), random_mesh(200, 150, seed),
                                       with_noise(make_sphere(0.7, 2), 0.02, seed)}) {
      TriangleMesh mesh = before;
      ASSERT_TRUE(smooth_nearest_farthest(mesh, {.boundary = BoundaryRule::free}));
      const auto expected = plain_equation_1(before.triangles, in_double(before.positions));
      EXPECT_LE(largest_difference(mesh.positions, expected), 2 * rounding);
    }
  }
}

TEST(NearestFarthest, LeavesTheInteriorOfEveryRegularGridWhereItIs) {
  for (const Diagonal diagonal : {Diagonal::rising, Diagonal::falling, Diagonal::alternating}) {
    for (const double spacing : {1., 0.1, 0.0123, 3.3e-3, 7.}) {
      for (const Vec3d shift : {Vec3d{}, Vec3d{0.3, -1.7, 0.9}}) {
        TriangleMesh mesh = make_grid(60, 40, spacing, diagonal);
        // Tilted, so that rounding disturbs every coordinate.
        double largest = 0;
        for (Vec3f& p : mesh.positions) {
          p = Vec3f(Vec3d{0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y, 0.25 * p.x} + shift);
          largest = std::max({largest, std::abs(double{p.x}), std::abs(double{p.y})});
        }
        const TriangleMesh before = mesh;
        const auto report = smooth_nearest_farthest(mesh, {.iterations = 5});
        ASSERT_TRUE(report);
        EXPECT_LE(report->max_move, 6 * largest * 0x1p-24);
      }
    }
  }
}

/// A vertex in the middle of four others at the given places, and they around it.
TriangleMesh pyramid(const std::vector<Vec3f>& around) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}};
  mesh.positions.insert(mesh.positions.end(), around.begin(), around.end());
  const auto n = static_cast<std::uint32_t>(around.size());
  for (std::uint32_t i = 0; i < n; ++i) mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
  return mesh;
}

TEST(NearestFarthest, CountsTheNearestAndTheFarthestTwice) {
  TriangleMesh mesh = pyramid({{1, 0, 0}, {0, 2, 0}, {-3, 0, 0}, {0, -2, 1}});
  ASSERT_TRUE(smooth_nearest_farthest(mesh));
  EXPECT_EQ(mesh.positions[0], (Vec3f{(1 + 1 - 3 - 3) / 6.f, 0, 1 / 6.f}));
}

TEST(NearestFarthest, TakesTheMeanOfTheTied) {
  TriangleMesh mesh = pyramid({{1, 0, 0}, {0, 1, 0}, {-4, 0, 0}, {0, 0, -2}});
  ASSERT_TRUE(smooth_nearest_farthest(mesh));
  const Vec3f expected{(1 - 4 + 0.5f - 4) / 6.f, (1 + 0.5f) / 6.f, -2 / 6.f};
  EXPECT_EQ(mesh.positions[0], expected);
}

TEST(NearestFarthest, DampingHoldsBackAShareOfTheMove) {
  const TriangleMesh before = with_noise(make_sphere(1, 2), 0.05, 3);
  TriangleMesh full = before, half = before;
  ASSERT_TRUE(smooth_nearest_farthest(full));
  ASSERT_TRUE(smooth_nearest_farthest(half, {.damping = 0.5}));
  for (std::size_t v = 0; v < before.positions.size(); ++v) {
    const Vec3d middle = 0.5 * (Vec3d(before.positions[v]) + Vec3d(full.positions[v]));
    EXPECT_LT(norm(Vec3d(half.positions[v]) - middle), 4e-7);
  }
}

TEST(NearestFarthest, ZeroIterationsChangeNothing) {
  TriangleMesh mesh = make_teapot();
  mesh.attributes.sigma.assign(mesh.positions.size(), 0.37f);
  const TriangleMesh before = mesh;
  const auto report = smooth_nearest_farthest(mesh, {.iterations = 0});
  ASSERT_TRUE(report);
  EXPECT_EQ(mesh, before);
  EXPECT_EQ(report->moved_vertices, 0u);
}

/// The same mesh with vertex v called (v + 1) % n, and back.
TriangleMesh relabelled(const TriangleMesh& mesh, std::uint32_t by) {
  const auto n = static_cast<std::uint32_t>(mesh.positions.size());
  TriangleMesh result = mesh;
  for (std::uint32_t v = 0; v < n; ++v) result.positions[(v + by) % n] = mesh.positions[v];
  for (Triangle& t : result.triangles) {
    for (std::uint32_t& v : t) v = (v + by) % n;
  }
  return result;
}

TEST(NearestFarthest, InPlaceDependsOnTheOrderOfVerticesAndJacobiDoesNot) {
  const TriangleMesh before = with_noise(make_sphere(1, 2), 0.05, 4);
  const auto n = static_cast<std::uint32_t>(before.positions.size());
  for (const UpdateOrder order : {UpdateOrder::jacobi, UpdateOrder::in_place}) {
    TriangleMesh one = before, other = relabelled(before, 50);
    ASSERT_TRUE(smooth_nearest_farthest(one, {.order = order}));
    ASSERT_TRUE(smooth_nearest_farthest(other, {.order = order}));
    const double difference =
        largest_difference(relabelled(other, n - 50).positions, in_double(one.positions));
    if (order == UpdateOrder::jacobi) {
      EXPECT_LT(difference, 2e-7);
    } else {
      EXPECT_GT(difference, 1e-3);
    }
  }
}

TEST(NearestFarthest, InPlaceIsThePrintedPseudoCode) {
  const TriangleMesh before = with_noise(make_torus(1, 0.4, 12, 8), 0.02, 5);
  const std::vector<Vec3d> old = in_double(before.positions);
  const Adjacency rings = one_rings(before);
  std::vector<Vec3d> expected = old;
  for (std::size_t i = 0; i < old.size(); ++i) {
    const auto ring = rings.row(i);
    const auto nearer = [&](std::uint32_t a, std::uint32_t b) {
      return norm(old[a] - old[i]) < norm(old[b] - old[i]);
    };
    Vec3d sum = expected[*std::min_element(ring.begin(), ring.end(), nearer)] +
                expected[*std::max_element(ring.begin(), ring.end(), nearer)];
    for (const std::uint32_t j : ring) sum += expected[j];
    expected[i] = sum / static_cast<double>(ring.size() + 2);
  }
  TriangleMesh mesh = before;
  ASSERT_TRUE(smooth_nearest_farthest(mesh, {.order = UpdateOrder::in_place}));
  EXPECT_LT(largest_difference(mesh.positions, expected), 2e-7);
}

TEST(NearestFarthest, TheBoundaryFollowsItsRule) {
  const TriangleMesh before = with_noise(make_grid(8, 8, 0.125), 0.02, 6);
  const std::vector<bool> on_boundary = boundary_vertices(before);
  const auto smoothed = [&](BoundaryRule rule) {
    TriangleMesh mesh = before;
    EXPECT_TRUE(smooth_nearest_farthest(mesh, {.boundary = rule}));
    return mesh;
  };
  const TriangleMesh fixed = smoothed(BoundaryRule::fixed);
  const TriangleMesh along = smoothed(BoundaryRule::along_boundary);
  const TriangleMesh free = smoothed(BoundaryRule::free);
  for (std::size_t v = 0; v < before.positions.size(); ++v) {
    if (on_boundary[v]) {
      EXPECT_EQ(fixed.positions[v], before.positions[v]);
      EXPECT_NE(free.positions[v], before.positions[v]);
    } else {
      EXPECT_NE(fixed.positions[v], before.positions[v]);
      EXPECT_EQ(fixed.positions[v], along.positions[v]);
      EXPECT_EQ(fixed.positions[v], free.positions[v]);
    }
  }
  // Vertex 4 lies on the lower side; both its neighbours along it count twice.
  const Vec3d middle = 0.5 * (Vec3d(before.positions[3]) + Vec3d(before.positions[5]));
  EXPECT_LT(norm(Vec3d(along.positions[4]) - middle), 1e-7);
  EXPECT_NE(along.positions[4], free.positions[4]);
}

TEST(NearestFarthest, OddMeshesAreSmoothedOrLeftButNeverBroken) {
  TriangleMesh two = make_grid(1, 1), lonely, degenerate = make_grid(3, 3);
  lonely.positions = {{1, 2, 3}, {4, 5, 6}};
  degenerate.triangles.push_back({5, 5, 6});
  degenerate.triangles.push_back({0, 0, 0});
  degenerate.positions[6] = degenerate.positions[5];
  for (const TriangleMesh& before :
       {two, lonely, degenerate, TriangleMesh{}, random_mesh(9, 60, 1)}) {
    for (const BoundaryRule rule :
         {BoundaryRule::fixed, BoundaryRule::along_boundary, BoundaryRule::free}) {
      TriangleMesh mesh = before;
      ASSERT_TRUE(smooth_nearest_farthest(mesh, {.iterations = 3, .boundary = rule}));
      EXPECT_TRUE(check(mesh));
    }
  }
}

TEST(NearestFarthest, ParametersOutOfRangeAreRefused) {
  TriangleMesh mesh = make_grid(2, 2);
  const TriangleMesh before = mesh;
  for (const NearestFarthestParams& params :
       {NearestFarthestParams{.iterations = -1}, NearestFarthestParams{.damping = 1},
        NearestFarthestParams{.damping = -0.1}}) {
    const auto report = smooth_nearest_farthest(mesh, params);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::invalid_argument);
  }
  EXPECT_EQ(mesh, before);
}

TEST(NearestFarthest, ACancelledRunLeavesTheMesh) {
  TriangleMesh mesh = make_sphere(1, 3);
  const TriangleMesh before = mesh;
  std::stop_source source;
  source.request_stop();
  Context context;
  context.stop = source.get_token();
  for (const UpdateOrder order : {UpdateOrder::jacobi, UpdateOrder::in_place}) {
    const auto report = smooth_nearest_farthest(mesh, {.order = order}, context);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::cancelled);
    EXPECT_EQ(mesh, before);
  }
}

}  // namespace
}  // namespace burnish
