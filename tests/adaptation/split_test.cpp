#include "burnish/adaptation/split.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "burnish/adaptation/closed_pair.h"
#include "burnish/adaptation/normal_arc.h"
#include "burnish/base/random.h"
#include "burnish/core/edges.h"
#include "burnish/measure/angle_between.h"
#include "burnish/shapes/shapes.h"
#include "support/random_mesh.h"
#include "support/refinement_promises.h"

namespace burnish {
namespace {

double length(const TriangleMesh& mesh, const Edge& edge) {
  return norm(Vec3d(mesh.positions[edge.vertices[0]]) - Vec3d(mesh.positions[edge.vertices[1]]));
}

double smallest_angle(const TriangleMesh& mesh) {
  double smallest = 4;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d p(mesh.positions[t[i]]);
      smallest = std::min(smallest, angle_between(Vec3d(mesh.positions[t[(i + 1) % 3]]) - p,
                                                  Vec3d(mesh.positions[t[(i + 2) % 3]]) - p));
    }
  }
  return smallest;
}

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) sum += norm(area_vector(mesh, t)) / 2;
  return sum;
}

TEST(Split, LeavesNoEdgeThatIsTooLong) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    for (const TriangleMesh& before :
         {test::random_mesh(20, 40, seed), test::with_noise(make_grid(6, 4), 0.2, seed),
          make_cylinder(1, 5, 6, 2)}) {
      TriangleMesh mesh = before;
      ASSERT_TRUE(refine_split(mesh, {.target_edge_length = 0.2}));
      const EdgeTable table = *EdgeTable::of(mesh);
      for (std::uint32_t e = 0; e < table.size(); ++e) {
        if (in_closed_pair(table, e)) continue;
        const auto [a, b] = table.vertices(e);
        EXPECT_LE(norm(Vec3d(mesh.positions[a]) - Vec3d(mesh.positions[b])), 0.2);
      }
      test::expect_no_cracks(before, mesh);
      EXPECT_NEAR(area(mesh), area(before), 1e-5 * area(before));
    }
  }
}

TEST(Split, SplitsWhatIsTooLongAndNothingElse) {
  TriangleMesh mesh = make_grid(4, 4);
  const TriangleMesh before = mesh;
  ASSERT_TRUE(refine_split(mesh, {.target_edge_length = 1.42}));  // the diagonals are shorter
  EXPECT_EQ(mesh, before);
  ASSERT_TRUE(refine_split(mesh, {.target_edge_length = 1.41}));
  EXPECT_EQ(mesh.positions.size(), 25u + 16);
  EXPECT_EQ(mesh.triangles.size(), 64u);
}

TEST(Split, TakesTheMeanWhereNoTargetIsGiven) {
  const TriangleMesh before = test::with_noise(make_grid(6, 4), 0.2, 1);
  TriangleMesh mesh = before, expected = before;
  ASSERT_TRUE(refine_split(mesh));
  ASSERT_TRUE(refine_split(expected, {.target_edge_length = mean_edge_length(before)}));
  EXPECT_EQ(mesh, expected);
  EXPECT_GT(mesh.triangles.size(), before.triangles.size());
}

TEST(Split, KeepsAnglesAboveHalfOfTheSmallest) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    TriangleMesh mesh = test::with_noise(make_grid(4, 4), 0.25, seed);
    const double before = smallest_angle(mesh);
    std::vector<float> weights(mesh.positions.size(), 0);
    weights[12] = weights[7] = 1;
    mesh = test::with_zone(mesh, weights);
    ASSERT_TRUE(refine_split(mesh, {.target_edge_length = 0.02}));
    EXPECT_GE(smallest_angle(mesh), before / 2 * 0.999) << seed;  // middles are rounded
  }
}

TEST(Split, AZoneIsAsFineAsItShouldBeAndTheRestIsNot) {
  const TriangleMesh before = make_grid(10, 10, 1);
  std::vector<float> weights(before.positions.size(), 0);
  for (const std::uint32_t v : {60u, 61u, 71u, 72u}) weights[v] = 1;
  TriangleMesh mesh = test::with_zone(before, weights);
  ASSERT_TRUE(refine_split(mesh, {.target_edge_length = 0.05}));
  const auto& now = std::get<std::vector<float>>(mesh.attributes.channels.front().values);
  std::size_t inside = 0;
  for (const Edge& edge : edges(mesh)) {
    if (now[edge.vertices[0]] < 1 && now[edge.vertices[1]] < 1) continue;
    EXPECT_LE(length(mesh, edge), 0.05);
    ++inside;
  }
  EXPECT_GT(inside, 2000u);  // two triangles of area 1/2 in edges of about 0.035
  EXPECT_LT(mesh.positions.size(), 10000u);
  EXPECT_NEAR(area(mesh), 100, 1e-4);
}

/// How far from the unit sphere the middles of edges are, at most.
double largest_chord(const TriangleMesh& mesh) {
  double largest = 0;
  for (const Edge& edge : edges(mesh)) {
    const auto [a, b] = edge.vertices;
    largest = std::max(largest, 1 - norm(Vec3d(mesh.positions[a]) + Vec3d(mesh.positions[b])) / 2);
  }
  return largest;
}

TEST(Split, FollowsTheNormalsOfARoundThing) {
  for (const double chord : {0.01, 0.001}) {
    TriangleMesh mesh = make_sphere(1, 1);
    mesh.attributes.normals = mesh.positions;
    ASSERT_GT(largest_chord(mesh), chord);
    ASSERT_TRUE(refine_split(mesh, {.max_chord = chord}));
    // Positions and the normals at first are rounded to floats, 1e-7 of 1, every time that an edge
    // is halved.
    for (const Vec3f& p : mesh.positions) EXPECT_NEAR(norm(Vec3d(p)), 1, 1e-6);
    EXPECT_LT(largest_chord(mesh), chord + 1e-6);
    EXPECT_LT(mesh.triangles.size(), 80 * 0.06 / chord * 4);
    EXPECT_EQ(topology(mesh).euler_number, 2);
  }
}

TEST(Split, LeavesTheSurfaceAroundAZone) {
  TriangleMesh before = make_uv_sphere(1, 4, 8);
  before.attributes.normals = before.positions;
  std::vector<float> weights(before.positions.size(), 0);
  weights[0] = 1;
  before = test::with_zone(before, weights);
  TriangleMesh mesh = before;
  ASSERT_TRUE(refine_split(mesh, {.max_chord = 0.0005}));
  const auto left = test::sides_along_edges(mesh);
  int split = 0;  // edges outside that are in the way
  for (const auto& [edge, sides] : test::sides_along_edges(before)) {
    if (edge[0] == 0 || left.count(edge)) continue;
    const Vec3f middle =
        Vec3f((Vec3d(before.positions[edge[0]]) + Vec3d(before.positions[edge[1]])) / 2.0);
    EXPECT_EQ(std::count(mesh.positions.begin(), mesh.positions.end(), middle), 1);
    ++split;
  }
  EXPECT_GT(split, 0);
}

TEST(Split, CutsTrianglesOnTheSameCornersAlike) {
  TriangleMesh mesh;  // two of them, and a third one along an edge
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0.3f, 0.9f, 0}, {0.5f, -0.8f, 0.2f}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 1}, {1, 0, 3}};
  ASSERT_TRUE(refine_split(mesh, {.target_edge_length = 0.1}));
  const Topology after = topology(mesh);
  EXPECT_GT(after.duplicate_triangles, 50u);
  EXPECT_EQ(after.components, 1u);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    EXPECT_EQ(std::count(mesh.positions.begin(), mesh.positions.end(), mesh.positions[v]), 1) << v;
  }
}

TEST(NormalArc, IsThatOfACircle) {
  for (const double phi : {0.01, 0.2, 0.45}) {  // half the angle
    const Vec3d a{-std::sin(phi), 0, std::cos(phi)}, b{std::sin(phi), 0, std::cos(phi)};
    const NormalArc arc(2.0 * (b - a), a, b);  // on a circle of radius 2
    EXPECT_NEAR(norm(arc.rise - Vec3d{0, 0, 2 * (1 - std::cos(phi))}), 0, 1e-15);
    EXPECT_NEAR(norm(arc.normal - Vec3d{0, 0, 1}), 0, 1e-15);
    const NormalArc hollow(2.0 * (a - b), a, b);
    EXPECT_NEAR(norm(hollow.rise + arc.rise), 0, 1e-15);
  }
}

TEST(NormalArc, GoesThroughTheMiddleOfAWave) {
  const Vec3d normal{0.6, 0, 0.8};  // the surface falls at both ends: it must rise between them
  const NormalArc arc({3, 0, 0}, normal, normal);
  EXPECT_EQ(norm(arc.rise), 0);
  EXPECT_NEAR(norm(arc.normal - Vec3d{-0.6, 0, 0.8}), 0, 1e-15);
}

TEST(NormalArc, RisesByAnEighthAtMost) {
  Random random(1);
  const auto direction = [&] {
    Vec3d v;
    for (std::size_t axis = 0; axis < 3; ++axis) v[axis] = random.uniform(-1, 1);
    return normalized(v);
  };
  double highest = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3d first = direction(), second = direction(), along = 5.0 * direction();
    highest = std::max(highest, norm(NormalArc(along, first, second).rise));
  }
  EXPECT_NEAR(highest, 5.0 / 8, 1e-12);
  const NormalArc folded({1, 0, 0}, {0, 0, 1}, {0, 0, -1});
  EXPECT_EQ(norm(folded.rise) + norm(folded.normal), 0);
}

TEST(Split, LeavesFlatPartsAloneWhereItFollowsNormals) {
  TriangleMesh mesh = make_grid(3, 3, 10);
  const TriangleMesh before = mesh;
  ASSERT_TRUE(refine_split(mesh, {.max_chord = 0.001}));
  EXPECT_EQ(mesh, before);
}

TEST(Split, EndsWhateverTheNormalsAre) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    TriangleMesh mesh = test::random_mesh(12, 20, seed);
    Random random(seed, 1);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      Vec3f normal;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        normal[axis] = static_cast<float>(random.uniform(-1, 1));
      }
      mesh.attributes.normals.push_back(normalized(normal));
    }
    const TriangleMesh before = mesh;
    const auto report = refine_split(mesh, {.max_chord = 0.01});
    ASSERT_TRUE(report);
    test::expect_no_cracks(before, mesh);
    double longest = 0;
    for (const Edge& edge : edges(before)) longest = std::max(longest, length(before, edge));
    EXPECT_LT(report->longest_edge, longest);
  }
}

TEST(Split, RefusesEdgesThatFloatsCannotTellApart) {
  TriangleMesh mesh = make_grid(1, 1, 1e-3);
  for (Vec3f& p : mesh.positions) p.x += 1000;
  const TriangleMesh before = mesh;
  for (const SplitParams& params :
       {SplitParams{.target_edge_length = 5e-4}, SplitParams{.max_chord = 1e-3}}) {
    const auto report = refine_split(mesh, params);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::invalid_argument);
    EXPECT_EQ(mesh, before);
  }
}

}  // namespace
}  // namespace burnish
