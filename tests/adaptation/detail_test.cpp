#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "burnish/adaptation/adaptive_mesh.h"
#include "burnish/base/rigid.h"
#include "burnish/shapes/shapes.h"
#include "support/adaptive_promises.h"
#include "support/random_mesh.h"

namespace burnish {
namespace {

constexpr double kDiagonal = 3.5;  // of the sphere of radius 1

AdaptiveMesh adaptive(const TriangleMesh& mesh) {
  auto made = AdaptiveMesh::make(mesh, test::random_removals(mesh, mesh.positions.size(), 1));
  EXPECT_TRUE(made) << made.error().text();
  return *std::move(made);
}

double farthest(const TriangleMesh& a, const TriangleMesh& b) {
  EXPECT_EQ(a.positions.size(), b.positions.size());
  double result = 0;
  for (std::size_t v = 0; v < a.positions.size(); ++v) {
    result = std::max(result, norm(Vec3d(a.positions[v]) - Vec3d(b.positions[v])));
  }
  return result;
}

TriangleMesh rough_sphere() {
  return test::with_noise(make_sphere(1, 4), 0.005, 1);
}

// Offsets are taken and put back in double from the same floats: what comes is at most one rounding
// to float from where it was, and does not add up. So 1e-5 of the diagonal leaves much room.
TEST(Detail, ComesBackWhereItWasWhereNothingWasEdited) {
  const TriangleMesh sphere = rough_sphere();
  AdaptiveMesh mesh = adaptive(sphere);
  mesh.to_triangles(400);
  mesh.remember_detail();
  EXPECT_EQ(mesh.triangle_count(), 400u);
  Random random(1);
  for (int i = 0; i < 50; ++i) test::random_operation(mesh, sphere, 2, random);
  mesh.restore();
  const TriangleMesh back = mesh.mesh();
  EXPECT_EQ(back.triangles, sphere.triangles);
  EXPECT_LT(farthest(back, sphere), 1e-6 * kDiagonal);
}

TEST(Detail, IsNotWantedByDefaultVerticesComeBackBitForBit) {
  const TriangleMesh sphere = rough_sphere();
  AdaptiveMesh mesh = adaptive(sphere);
  mesh.to_triangles(400);
  EXPECT_FALSE(mesh.remembers_detail());
  std::vector<Vec3f> moved = mesh.mesh().positions;
  for (Vec3f& p : moved) p *= 2.0f;
  const std::vector<std::uint32_t> kept = mesh.vertices();
  ASSERT_TRUE(mesh.set_positions(moved));
  mesh.restore();
  TriangleMesh expected = sphere;
  for (std::size_t v = 0; v < kept.size(); ++v) expected.positions[kept[v]] = moved[v];
  EXPECT_EQ(mesh.mesh(), expected);
}

// A rough plane bent around a cylinder at its coarse level: what stood out of the plane stands out
// of the cylinder as far, and what was in the plane lies on triangles between points of the
// cylinder, so at most their sagitta below it.
TEST(Detail, StandsOutOfABentSurfaceAsItStoodOutOfThePlane) {
  constexpr double kRadius = 20, kBump = 0.5;
  TriangleMesh plane = make_grid(24, 24);
  const std::uint32_t bump = 12 * 25 + 12;
  plane.positions[bump].z = static_cast<float>(kBump);
  std::vector<Removal> log;
  // The bump and then its neighbours to the left and right, into their upper neighbours.
  for (const std::uint32_t v : {bump, bump - 1, bump + 1}) log.push_back({v, v + 25, 0});
  auto mesh = AdaptiveMesh::make(plane, log);
  ASSERT_TRUE(mesh) << mesh.error().text();
  mesh->to_removals(3);
  mesh->remember_detail();
  std::vector<Vec3f> bent = mesh->mesh().positions;
  for (Vec3f& p : bent) {
    const double angle = (static_cast<double>(p.x) - 12) / kRadius,
                 r = kRadius + static_cast<double>(p.z);
    p = Vec3f(Vec3d{r * std::sin(angle), static_cast<double>(p.y), r * std::cos(angle)});
  }
  ASSERT_TRUE(mesh->set_positions(bent));
  mesh->restore();
  const Vec3d top(mesh->mesh().positions[bump]);
  const double sagitta = 2 * 2 / (2 * kRadius);  // of a chord of 4
  EXPECT_NEAR(std::hypot(top.x, top.z), kRadius + kBump, sagitta);
  EXPECT_NEAR(top.x, 0, sagitta);
  EXPECT_NEAR(top.y, 12, sagitta);

  mesh->to_removals(3);
  mesh->forget_detail();
  std::vector<Vec3f> flat = mesh->mesh().positions;
  for (Vec3f& p : flat) p.z = 0;
  ASSERT_TRUE(mesh->set_positions(flat));
  mesh->restore();
  EXPECT_EQ(Vec3d(mesh->mesh().positions[bump]), top) << "forgotten: where it last was";
}

TEST(Detail, OfAVertexThatWasMovedItselfIsKept) {
  const TriangleMesh sphere = rough_sphere();
  AdaptiveMesh mesh = adaptive(sphere);
  mesh.remember_detail();
  TriangleMesh edited = sphere;
  for (std::size_t v = 0; v < edited.positions.size(); v += 3) edited.positions[v] *= 1.1f;
  ASSERT_TRUE(mesh.set_positions(edited.positions));
  mesh.to_triangles(100);
  mesh.restore();
  EXPECT_LT(farthest(mesh.mesh(), edited), 1e-6 * kDiagonal);
}

TEST(Detail, EditsGiveNewNormalsAndBadOnesAreRefused) {
  TriangleMesh sphere = make_sphere(1, 3);
  sphere.attributes.normals.assign(sphere.positions.size(), {0, 0, 1});
  AdaptiveMesh mesh = adaptive(sphere);
  mesh.to_triangles(200);
  EXPECT_EQ(mesh.mesh().attributes.normals.front(), (Vec3f{0, 0, 1}));
  std::vector<Vec3f> positions = mesh.mesh().positions;
  positions.pop_back();
  const auto shorter = mesh.set_positions(positions);
  ASSERT_FALSE(shorter);
  EXPECT_EQ(shorter.error().code, ErrorCode::invalid_argument);
  positions.push_back({0, std::numeric_limits<float>::quiet_NaN(), 0});
  const auto broken = mesh.set_positions(positions);
  ASSERT_FALSE(broken);
  EXPECT_EQ(broken.error().code, ErrorCode::bad_geometry);
  positions.back() = {0, 0, 0};
  ASSERT_TRUE(mesh.set_positions(positions));
  const TriangleMesh edited = mesh.mesh();
  EXPECT_EQ(edited.attributes.normals, vertex_normals(edited));
}

// Rounding of the moved positions turns the frame of a star by about its error over the star's
// width; random removals leave triangles that are thousands of times longer than wide.
TEST(Detail, FollowsARigidMotion) {
  const TriangleMesh sphere = rough_sphere();
  AdaptiveMesh mesh = adaptive(sphere);
  mesh.to_triangles(1000);
  mesh.remember_detail();
  const RigidTransform T = rigid_from_quaternion(1, 2, 3, 4, {5, -7, 9});
  const auto moved = [&](TriangleMesh m) {
    for (Vec3f& p : m.positions) p = Vec3f(T(Vec3d(p)));
    return m;
  };
  ASSERT_TRUE(mesh.set_positions(moved(mesh.mesh()).positions));
  mesh.restore();
  EXPECT_LT(farthest(mesh.mesh(), moved(sphere)), 1e-4 * kDiagonal);
}

}  // namespace
}  // namespace burnish
