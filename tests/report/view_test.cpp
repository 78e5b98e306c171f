#include "burnish/report/view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "burnish/shapes/shapes.h"

namespace burnish {
namespace {

constexpr double kAspect = 4.0 / 3;

/// The largest of |x| / width and |y| / height over all vertices: 1 at the edge of the picture.
double reach(const TriangleMesh& mesh, const View& view) {
  const RigidTransform to_camera = view.T_world_camera.inverse();
  double largest = 0;
  for (const Vec3f& position : mesh.positions) {
    const Vec3d p = to_camera(mesh.frame.origin + Vec3d(position));
    EXPECT_GT(p.z, 0);
    const double half = view.half_height * p.z;
    largest = std::max({largest, std::abs(p.x) / (half * kAspect), std::abs(p.y) / half});
  }
  return largest;
}

TEST(FramingView, ShowsAllOfAMeshAsLargeAsPossible) {
  for (const TriangleMesh& mesh : {make_torus(), make_box({3, 0.1, 0.2}, 2), make_grid(5, 3)}) {
    for (const View& view : standard_views(mesh, {0, 1, 0}, {0, 0, 1}, kAspect)) {
      const double seen = reach(mesh, view);
      EXPECT_LE(seen, 1) << view.name;
      EXPECT_GE(seen, 0.9) << view.name << ": the margin is 6 %";
    }
  }
}

TEST(FramingView, IsNotLedAstrayByOneFarPoint) {
  TriangleMesh mesh = make_sphere(1, 5);
  ASSERT_GE(mesh.positions.size(), 2000u);
  mesh.positions.front() = {0, 0, 1000};
  const View view = framing_view("front", mesh, {0, 1, 0}, {0, 0, 1}, kAspect);
  EXPECT_LT(norm(view.T_world_camera.translation), 10);
}

TEST(FramingView, FollowsTheFrameAndIgnoresUnusedVertices) {
  const TriangleMesh mesh = make_torus();
  TriangleMesh moved = mesh;
  moved.frame.origin = {1000, 2000, 3000};
  moved.positions.push_back({50, 50, 50});
  const View a = framing_view("a", mesh, {0, 1, 0}, {0, 0, 1}, kAspect);
  const View b = framing_view("b", moved, {0, 1, 0}, {0, 0, 1}, kAspect);
  const Vec3d shift = b.T_world_camera.translation - a.T_world_camera.translation;
  // Sums with numbers around 3000 round at 2^-41.
  EXPECT_LT(norm(shift - moved.frame.origin), 1e-9);
}

TEST(FramingView, OfNothingOrOfOnePointIsFinite) {
  TriangleMesh point;
  point.positions = {{2, 2, 2}};
  point.triangles = {{0, 0, 0}};
  for (const TriangleMesh& mesh : {TriangleMesh{}, point}) {
    for (const View& view : standard_views(mesh, {0, 1, 0}, {0, 0, 1}, kAspect)) {
      EXPECT_TRUE(is_finite(view.T_world_camera.translation));
    }
    const View wide = framing_view("wide", mesh, {0, 1, 0}, {0, 0, 1}, kAspect);
    EXPECT_GT(close_up(mesh, wide).half_height, 0);
  }
}

TEST(CloseUp, IsAsHighAsEighteenEdges) {
  const TriangleMesh mesh = make_grid(100, 100, 0.01);
  const View wide = framing_view("wide", mesh, {0, 0, -1}, {0, 1, 0}, kAspect);
  const View close = close_up(mesh, wide);
  // The grid lies in z = 0; two of three edges are 0.01 m long, and so is the median.
  const double height = 2 * close.half_height * close.T_world_camera.translation.z;
  EXPECT_NEAR(height, 18 * 0.01, 0.02 * height) << "the line of sight is not quite upright";
}

}  // namespace
}  // namespace burnish
