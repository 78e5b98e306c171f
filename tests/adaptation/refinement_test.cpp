// What holds for every refinement.
#include "burnish/adaptation/refinement.h"

#include <cmath>
#include <numbers>

#include "burnish/base/random.h"
#include "burnish/shapes/shapes.h"
#include "support/random_mesh.h"
#include "support/refinement_promises.h"

namespace burnish {
namespace {

using test::refined;
using test::Refinement;
using test::refinements;
using test::with_zone;

/// 1 for vertices of random, connected parts of the mesh, else 0.
std::vector<float> random_zone(const TriangleMesh& mesh, std::uint64_t seed) {
  Random random(seed);
  std::vector<float> weights(mesh.positions.size(), 0);
  if (mesh.triangles.empty()) return weights;
  for (int i = 0; i < 3; ++i) {
    for (const std::uint32_t v : mesh.triangles[random.below(mesh.triangles.size())]) {
      weights[v] = 1;
    }
  }
  return weights;
}

/// A band with a half twist: however its triangles are turned, two along an edge disagree.
TriangleMesh moebius_band() {
  constexpr std::uint32_t kSquares = 12;
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < kSquares; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSquares;
    for (const double across : {-0.3, 0.3}) {
      const double radius = 1 + across * std::cos(angle / 2);
      mesh.positions.push_back(Vec3f(
          Vec3d{radius * std::cos(angle), radius * std::sin(angle), across * std::sin(angle / 2)}));
    }
    const std::uint32_t a = 2 * i, b = a + 1, turned = i + 1 == kSquares;
    const std::uint32_t c = turned ? 1 : a + 2, d = turned ? 0 : a + 3;
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({b, d, c});
  }
  return mesh;
}

std::vector<TriangleMesh> surfaces() {
  TriangleMesh open = make_sphere(1, 2);
  open.triangles.erase(open.triangles.begin() + 10, open.triangles.begin() + 90);
  return {make_sphere(1, 2),
          make_torus(1, 0.4, 12, 8),
          make_box({1, 1, 1}, 3),
          open,
          make_grid(5, 4, 0.3, Diagonal::alternating),
          moebius_band()};
}

TEST(Refinement, KeepsTheKindOfSurface) {
  for (const Refinement& method : refinements()) {
    for (const TriangleMesh& mesh : surfaces()) {
      SCOPED_TRACE(method.name);
      const TriangleMesh after = refined(mesh, method);
      test::expect_same_topology(mesh, after);
      if (!method.name.ends_with("chord")) {
        EXPECT_GT(after.triangles.size(), mesh.triangles.size());
      }
    }
  }
}

TEST(Refinement, LeavesNoCracksAroundAZone) {
  for (const Refinement& method : refinements()) {
    for (const TriangleMesh& mesh : surfaces()) {
      for (std::uint64_t seed = 0; seed < 5; ++seed) {
        SCOPED_TRACE(method.name);
        const TriangleMesh before = with_zone(mesh, random_zone(mesh, seed));
        const TriangleMesh after = refined(before, method);
        test::expect_same_topology(before, after);
        EXPECT_LE(after.triangles.size(), refined(mesh, method).triangles.size());
      }
    }
  }
}

TEST(Refinement, AZoneOfAllVerticesIsNone) {
  for (const Refinement& method : refinements()) {
    const TriangleMesh mesh = make_sphere(1, 2);
    TriangleMesh confined =
        refined(with_zone(mesh, std::vector<float>(mesh.positions.size(), 1)), method);
    EXPECT_EQ(std::get<std::vector<float>>(confined.attributes.channels.front().values),
              std::vector<float>(confined.positions.size(), 1));
    confined.attributes.channels.clear();
    EXPECT_EQ(confined, refined(mesh, method)) << method.name;
  }
}

TEST(Refinement, NothingMovesOrIsCutFarFromAZone) {
  const TriangleMesh mesh = test::with_noise(make_grid(20, 20, 0.1), 0.01, 1);
  std::vector<float> weights(mesh.positions.size(), 0);
  weights[0] = 1;
  for (const Refinement& method : refinements()) {
    const TriangleMesh after = refined(with_zone(mesh, weights), method);
    for (std::size_t v = 1; v < mesh.positions.size(); ++v) {
      EXPECT_EQ(after.positions[v], mesh.positions[v]) << method.name;
    }
    for (std::size_t v = mesh.positions.size(); v < after.positions.size(); ++v) {
      EXPECT_LT(norm(after.positions[v]), 0.35f) << method.name;
    }
  }
}

TEST(Refinement, OnlyRefusesZonesThatCannotBe) {
  const TriangleMesh mesh = make_box();
  for (const Refinement& method : refinements()) {
    for (Channel::Values bad : {Channel::Values(std::vector<float>(8, 1.5f)),
                                Channel::Values(std::vector<std::uint8_t>(8, 1))}) {
      TriangleMesh broken = mesh;
      broken.attributes.channels.push_back({std::string(kRefinement), std::move(bad)});
      const TriangleMesh before = broken;
      const auto report = method.run(broken, {});
      ASSERT_FALSE(report) << method.name;
      EXPECT_EQ(report.error().code, ErrorCode::bad_geometry);
      EXPECT_EQ(broken, before);
    }
    EXPECT_EQ(refined(with_zone(mesh, std::vector<float>(8, 0.75f)), method).triangles.size(), 12u)
        << method.name;
  }
}

TEST(Refinement, AnAffineMapOfTheMeshIsOneOfTheResult) {
  const auto map = [](TriangleMesh mesh) {
    for (Vec3f& p : mesh.positions) {
      p = Vec3f(Vec3d{p.x + 0.5 * p.y - 1, 2.0 * p.y - 0.25 * p.z, p.z + 0.75 * p.x + 3});
    }
    return mesh;
  };
  TriangleMesh mesh = make_sphere(1, 2);
  mesh.triangles.resize(250);  // with a boundary
  for (const Refinement& method : refinements()) {
    if (method.name.starts_with("split")) continue;  // which edges are long is no affine matter
    const TriangleMesh once = map(refined(mesh, method)), other = refined(map(mesh), method);
    ASSERT_EQ(once.triangles, other.triangles) << method.name;
    for (std::size_t v = 0; v < once.positions.size(); ++v) {
      // Floats of at most 5 are rounded by 2.4e-7, twice on either way, and added up by the map.
      EXPECT_LT(norm(Vec3d(once.positions[v]) - Vec3d(other.positions[v])), 4e-6) << method.name;
    }
  }
}

TEST(Refinement, TellsOfNewVerticesWhatIsKnown) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.attributes.colors = {{10, 20, 30, 255}, {20, 20, 31, 255}, {0, 0, 0, 0}};
  mesh.attributes.sigma = {1, 2, 0.5f};
  mesh.attributes.noise = {{{0, 0, 1}, 1, 1}, {{1, 0, 0}, 3, 1}, {{0, 1, 0}, 3, 2}};
  mesh.attributes.observations = {3, 2, 9};
  mesh.attributes.origin = {Origin::invented, Origin::invented, Origin::seen};
  mesh.attributes.normals.assign(3, {0, 1, 0});
  mesh.attributes.channels = {{"height", std::vector<double>{1, 4, 10}},
                              {"label", std::vector<std::int16_t>{7, 5, 6}}};
  mesh.triangle_attributes = {{Origin::invented}, {2}};
  ASSERT_TRUE(refine_midpoint(mesh));
  const Attributes& a = mesh.attributes;  // the new ones are between 0 1, 0 2, and 1 2
  const auto added = [](const auto& values) {
    return std::vector(values.begin() + 3, values.end());
  };
  EXPECT_EQ(added(a.colors),
            (std::vector<Color>{{15, 20, 31, 255}, {5, 10, 15, 128}, {10, 10, 16, 128}}));
  EXPECT_EQ(added(a.sigma), (std::vector<float>{2, 1, 2}));
  EXPECT_EQ(a.noise[3], mesh.attributes.noise[1]);
  EXPECT_EQ(a.noise[5], mesh.attributes.noise[2]);
  EXPECT_EQ(added(a.observations), (std::vector<std::uint32_t>{2, 3, 2}));
  EXPECT_EQ(added(a.origin),
            (std::vector{Origin::invented, Origin::interpolated, Origin::interpolated}));
  EXPECT_EQ(a.normals, std::vector<Vec3f>(6, {0, 0, 1}));
  EXPECT_EQ(std::get<std::vector<double>>(a.channels[0].values),
            (std::vector<double>{1, 4, 10, 2.5, 5.5, 7}));
  EXPECT_EQ(std::get<std::vector<std::int16_t>>(a.channels[1].values),
            (std::vector<std::int16_t>{7, 5, 6, 5, 6, 5}));
  EXPECT_EQ(mesh.triangle_attributes.origin, std::vector(4, Origin::invented));
  EXPECT_EQ(mesh.triangle_attributes.owner, std::vector<std::uint32_t>(4, 2));
}

TEST(Refinement, MarksNewVerticesWhereNoOriginWasKnown) {
  for (const Refinement& method : refinements()) {
    const TriangleMesh before = make_sphere(1, 2), after = refined(before, method);
    ASSERT_EQ(after.attributes.origin.size(), after.positions.size()) << method.name;
    for (std::size_t v = 0; v < after.positions.size(); ++v) {
      EXPECT_EQ(after.attributes.origin[v],
                v < before.positions.size() ? Origin::seen : Origin::interpolated);
    }
  }
  TriangleMesh untouched = make_sphere(1, 2);
  ASSERT_TRUE(refine_loop(untouched, {0}));
  EXPECT_TRUE(untouched.attributes.origin.empty());
}

TEST(Refinement, SigmaIsNoSmallerThanOfWhatAVertexIsMadeOf) {
  for (const Refinement& method : refinements()) {
    TriangleMesh mesh = make_sphere(1, 1);
    mesh.attributes.sigma.assign(mesh.positions.size(), 0.001f);
    const TriangleMesh even = refined(mesh, method);
    for (const float sigma : even.attributes.sigma) EXPECT_NEAR(sigma, 0.001f, 1e-9f);
    mesh.attributes.sigma[0] = 1;
    const TriangleMesh after = refined(mesh, method);
    for (std::size_t v = 0; v < after.positions.size(); ++v) {
      EXPECT_GE(after.attributes.sigma[v], even.attributes.sigma[v] * 0.999999f) << method.name;
    }
    if (method.name.starts_with("split")) continue;  // of which edges are new themselves
    for (const auto& [edge, sides] : test::sides_along_edges(after)) {
      if (edge[0] != 0 || edge[1] < mesh.positions.size()) continue;
      EXPECT_EQ(after.attributes.sigma[edge[1]], 1) << method.name;
    }
  }
}

TEST(Refinement, RefusesMoreThanCanBeNumbered) {
  TriangleMesh mesh = make_sphere(1, 3);
  const TriangleMesh before = mesh;
  for (const auto& report :
       {refine_loop(mesh, {12}), refine_midpoint(mesh, {16}), refine_sqrt3(mesh, {15}),
        refine_split(mesh, {.target_edge_length = 2e-5})}) {
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::invalid_argument) << report.error().text();
    EXPECT_EQ(mesh, before);
  }
}

TEST(Refinement, LeavesVerticesWithoutTriangles) {
  for (const Refinement& method : refinements()) {
    TriangleMesh mesh = make_box();
    mesh.positions.push_back({7, 8, 9});
    const TriangleMesh after = refined(mesh, method);
    EXPECT_EQ(after.positions[8], mesh.positions[8]) << method.name;
    EXPECT_EQ(topology(after).unused_vertices, 1u) << method.name;
    mesh.triangles.clear();
    EXPECT_EQ(refined(mesh, method), mesh) << method.name;
  }
}

TEST(Refinement, KeepsTwoTrianglesOnTheSameCornersManifold) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 3, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
  for (const Refinement& method : refinements()) {
    SCOPED_TRACE(method.name);
    const Topology after = topology(refined(mesh, method));
    EXPECT_EQ(after.euler_number, 2);
    EXPECT_TRUE(after.oriented() && after.closed());
  }
}

/// Vertices on a grid of ten cells a side, so that many coincide or lie in line.
TriangleMesh on_coarse_grid(TriangleMesh mesh) {
  for (Vec3f& p : mesh.positions) {
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = std::round(5 * p[axis]) / 5;
  }
  return mesh;
}

TEST(Refinement, SurvivesAnyTriangles) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Random random(seed);
    const std::size_t vertices = 2 + random.below(12);
    const std::size_t triangles = random.below(25);
    const TriangleMesh mesh = on_coarse_grid(test::random_mesh(vertices, triangles, seed));
    for (const bool confined : {false, true}) {
      TriangleMesh first;
      for (const Refinement& method : refinements(0.05)) {
        SCOPED_TRACE(method.name + ", seed " + std::to_string(seed));
        const TriangleMesh before = confined ? with_zone(mesh, random_zone(mesh, seed)) : mesh;
        const TriangleMesh after = refined(before, method);
        ASSERT_TRUE(check(after));
        EXPECT_GE(after.triangles.size(), before.triangles.size());
        test::expect_no_cracks(before, after);
        // The second pass goes on from what the first one gives.
        const bool twice = method.name.ends_with("twice");
        if (twice) test::expect_no_cracks(first, after);
        first = after;
      }
    }
  }
}

TEST(Refinement, KeepsTheKindOfSurfaceWhateverItsShape) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    for (TriangleMesh mesh : surfaces()) {
      mesh = on_coarse_grid(test::with_noise(std::move(mesh), 0.3, seed));
      mesh = with_zone(mesh, random_zone(mesh, seed));
      for (const Refinement& method : refinements(0.05)) {
        SCOPED_TRACE(method.name + ", seed " + std::to_string(seed));
        test::expect_same_topology(mesh, refined(mesh, method));
      }
    }
  }
}

}  // namespace
}  // namespace burnish
