#include "burnish/shapes/shapes.h"

#include <gtest/gtest.h>

#include <numbers>

#include "burnish/core/topology.h"

namespace burnish {
namespace {

double volume(const TriangleMesh& mesh) {
  double six_times = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    six_times +=
        dot(Vec3d(mesh.positions[a]), cross(Vec3d(mesh.positions[b]), Vec3d(mesh.positions[c])));
  }
  return six_times / 6;
}

void expect_closed(const TriangleMesh& mesh, std::int64_t euler_number) {
  EXPECT_TRUE(check(mesh));
  const Topology t = topology(mesh);
  EXPECT_TRUE(t.closed());
  EXPECT_TRUE(t.oriented());
  EXPECT_EQ(t.non_manifold_vertices, 0u);
  EXPECT_EQ(t.unused_vertices, 0u);
  EXPECT_EQ(t.degenerate_triangles, 0u);
  EXPECT_EQ(t.components, 1u);
  EXPECT_EQ(t.euler_number, euler_number);
}

constexpr double kPi = std::numbers::pi;

TEST(Shapes, ABoxIsClosedOutwardsAndOfItsVolume) {
  for (const int cells : {1, 2, 5}) {
    const TriangleMesh mesh = make_box({1, 2, 3}, cells);
    expect_closed(mesh, 2);
    EXPECT_EQ(mesh.triangles.size(), static_cast<std::size_t>(12 * cells * cells));
    EXPECT_NEAR(volume(mesh), 6, 1e-5);
  }
}

TEST(Shapes, ASphereFillsTheBallAsItIsRefined) {
  for (const int subdivisions : {0, 1, 5}) {
    const TriangleMesh mesh = make_sphere(2, subdivisions);
    expect_closed(mesh, 2);
    EXPECT_EQ(mesh.triangles.size(), std::size_t{20} << (2 * subdivisions));
    for (const Vec3f& p : mesh.positions) EXPECT_NEAR(norm(Vec3d(p)), 2, 4e-7);
  }
  EXPECT_NEAR(volume(make_sphere(2, 5)) / (32 * kPi / 3), 1, 2e-3);
  const TriangleMesh mesh = make_uv_sphere(2, 128, 64);
  expect_closed(mesh, 2);
  EXPECT_EQ(mesh.triangles.size(), 2u * 128 * 63);
  EXPECT_NEAR(volume(mesh) / (32 * kPi / 3), 1, 2e-3);
}

TEST(Shapes, ATorusHasOneHandle) {
  const TriangleMesh mesh = make_torus(2, 0.5, 200, 100);
  expect_closed(mesh, 0);
  EXPECT_NEAR(volume(mesh) / (2 * kPi * kPi * 2 * 0.25), 1, 2e-3);
}

TEST(Shapes, ACylinderIsClosed) {
  const TriangleMesh mesh = make_cylinder(1, 3, 200, 4);
  expect_closed(mesh, 2);
  EXPECT_NEAR(volume(mesh) / (3 * kPi), 1, 2e-3);
}

TEST(Shapes, AGridFacesUpwardsWhicheverItsDiagonal) {
  for (const Diagonal diagonal : {Diagonal::rising, Diagonal::falling, Diagonal::alternating}) {
    const TriangleMesh mesh = make_grid(4, 3, 0.5, diagonal);
    EXPECT_EQ(mesh.positions.size(), 20u);
    EXPECT_EQ(mesh.triangles.size(), 24u);
    EXPECT_EQ(mesh.positions[1 * 5 + 2], (Vec3f{1, 0.5f, 0}));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      EXPECT_EQ(area_vector(mesh, t), (Vec3d{0, 0, 0.25}));
    }
    EXPECT_TRUE(topology(mesh).oriented());
    EXPECT_EQ(topology(mesh).boundary_edges, 14u);
  }
}

TEST(Shapes, EveryNameMakesAThingThatStandsOnTheTable) {
  for (const std::string_view name : shape_names()) {
    SCOPED_TRACE(name);
    const auto mesh = make_shape(name);
    ASSERT_TRUE(mesh);
    EXPECT_TRUE(check(*mesh));
    EXPECT_TRUE(topology(*mesh).oriented());
    Vec3f low = mesh->positions[0], high = low;
    for (const Vec3f& p : mesh->positions) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], p[axis]);
        high[axis] = std::max(high[axis], p[axis]);
      }
    }
    EXPECT_EQ(low.z, 0.f);
    EXPECT_LT(norm(Vec3d(high) - Vec3d(low)), 0.6);
    EXPECT_GT(norm(Vec3d(high) - Vec3d(low)), 0.3);
  }
}

TEST(Shapes, AnUnknownNameIsAnsweredWithTheKnownOnes) {
  const auto mesh = make_shape("cow");
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().code, ErrorCode::invalid_argument);
  EXPECT_NE(mesh.error().message.find("sphere"), std::string::npos);
}

}  // namespace
}  // namespace burnish
