#include "burnish/triangulation/delaunay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "burnish/base/random.h"
#include "burnish/base/rigid.h"
#include "burnish/core/topology.h"

namespace burnish {
namespace {

/// A wavy sheet over the unit square, z = up to 0.1, at random places.
PointCloud sheet(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  PointCloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.uniform(), y = random.uniform();
    cloud.positions.push_back(Vec3f(Vec3d{x, y, 0.1 * std::sin(5 * x) * std::cos(4 * y)}));
  }
  return cloud;
}

/// A lattice of whole coordinates at z = 0.
PointCloud lattice(int width, int height) {
  PointCloud cloud;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      cloud.positions.push_back({static_cast<float>(x), static_cast<float>(y), 0});
    }
  }
  return cloud;
}

PointCloud turned(PointCloud cloud, const RigidTransform& turn) {
  for (Vec3f& p : cloud.positions) p = Vec3f(turn(Vec3d(p)));
  return cloud;
}

Triangulation triangulated(const PointCloud& cloud, const DelaunayParams& params = {}) {
  auto result = triangulate_delaunay(cloud, params);
  EXPECT_TRUE(result) << result.error().text();
  return result ? *std::move(result) : Triangulation{};
}

/// How many triangles look along `direction`, less those that look against it.
std::int64_t facing(const TriangleMesh& mesh, const Vec3d& direction) {
  std::int64_t count = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    count += dot(area_vector(mesh, t), direction) > 0 ? 1 : -1;
  return count;
}

std::vector<std::array<Vec3f, 3>> soup(const TriangleMesh& mesh) {
  const auto less = [](const Vec3f& a, const Vec3f& b) {
    return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
  };
  std::vector<std::array<Vec3f, 3>> result;
  for (const Triangle& t : mesh.triangles) {
    std::array<Vec3f, 3> corners{mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end(), less),
                corners.end());
    result.push_back(corners);
  }
  std::sort(result.begin(), result.end(), [&](const auto& a, const auto& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), less);
  });
  return result;
}

TEST(TriangulateDelaunay, CoversASheetInEveryProjectionThatSeesItFromTheFront) {
  PointCloud cloud = sheet(2000, 1);
  cloud.viewpoint = Vec3d{0.4, 0.6, 3};
  for (const Projection projection : {Projection::plane, Projection::z, Projection::view}) {
    const Triangulation result = triangulated(cloud, {.projection = projection});
    const Topology t = topology(result.mesh);
    EXPECT_EQ(result.mesh.positions, cloud.positions);
    EXPECT_EQ(t.components, 1u);
    EXPECT_EQ(t.boundary_loops, 1u);
    EXPECT_EQ(t.euler_number, 1);
    EXPECT_TRUE(t.oriented());
    EXPECT_EQ(t.non_manifold_vertices, 0u);
  }
}

TEST(TriangulateDelaunay, FacesTheViewpointElseTheNormalsElseUp) {
  PointCloud cloud = sheet(300, 2);
  const auto up = [&](Projection projection = Projection::plane) {
    const TriangleMesh mesh = triangulated(cloud, {.projection = projection}).mesh;
    const std::int64_t sum = facing(mesh, {0, 0, 1});
    EXPECT_GT(std::abs(sum), static_cast<std::int64_t>(9 * mesh.triangles.size() / 10));
    return sum > 0;
  };
  EXPECT_TRUE(up());
  EXPECT_TRUE(up(Projection::z));
  cloud.attributes.normals.assign(300, {0, 0, -1});
  EXPECT_FALSE(up());
  EXPECT_FALSE(up(Projection::z));
  cloud.viewpoint = Vec3d{0, 0, 5};
  EXPECT_TRUE(up());
  EXPECT_TRUE(up(Projection::view));
  cloud.viewpoint = Vec3d{0, 0, -5};
  EXPECT_FALSE(up(Projection::z));
  EXPECT_FALSE(up(Projection::view));
  cloud.frame.origin = {0, 0, -10};  // which puts the sheet below the viewpoint
  EXPECT_TRUE(up(Projection::view));
}

TEST(TriangulateDelaunay, SeesALatticeAlongItsAxisWithoutRounding) {
  // The same lattice in the three coordinate planes, and tilted: every square has two triangles.
  const RigidTransform to_x{{{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}}, {}};
  const RigidTransform to_y{{{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}}, {}};
  const PointCloud flat = lattice(40, 25);
  const std::size_t expected = 2u * 39 * 24;
  EXPECT_EQ(triangulated(flat).mesh.triangles.size(), expected);
  EXPECT_EQ(triangulated(flat, {.projection = Projection::z}).mesh.triangles.size(), expected);
  for (const auto& [turn, projection] :
       {std::pair(to_x, Projection::x), std::pair(to_y, Projection::y)}) {
    const PointCloud upright = turned(flat, turn);
    EXPECT_EQ(triangulated(upright).mesh.triangles.size(), expected);
    EXPECT_EQ(triangulated(upright, {.projection = projection}).mesh.triangles.size(), expected);
    EXPECT_TRUE(triangulated(upright, {.projection = Projection::z}).mesh.triangles.empty());
  }
}

TEST(TriangulateDelaunay, LeavesNoSliversWhereRoundingBendsALine) {
  // Coordinates that a float holds exactly, in a plane and along a line across all axes.
  PointCloud plane, line;
  for (int i = 0; i < 30; ++i) {
    for (int j = 0; j < 20; ++j) {
      plane.positions.push_back(Vec3f(Vec3d{1. * i + j, 2. * i - j, 3. * j - i}));
    }
    line.positions.push_back(Vec3f(Vec3d{3. * i, -7. * i, 2. * i}));
  }
  EXPECT_EQ(triangulated(plane).mesh.triangles.size(), 2u * 29 * 19);
  const Triangulation nothing = triangulated(line);
  EXPECT_TRUE(nothing.mesh.triangles.empty());
  EXPECT_EQ(nothing.report.unused_points, 30u);
}

TEST(TriangulateDelaunay, DoesNotDependOnTheOrderOfThePoints) {
  PointCloud tilted = turned(lattice(40, 30), rigid_from_quaternion(.1, .4, -.2, .8, {1, 2, 3}));
  for (PointCloud cloud : {sheet(3000, 3), lattice(50, 40), tilted}) {
    cloud.viewpoint = Vec3d{.5, .5, 50};
    for (const Projection projection : {Projection::plane, Projection::z, Projection::view}) {
      PointCloud shuffled = cloud;
      Random random(4);
      for (std::size_t i = cloud.positions.size(); i > 1; --i)
        std::swap(shuffled.positions[i - 1], shuffled.positions[random.below(i)]);
      EXPECT_EQ(soup(triangulated(shuffled, {.projection = projection}).mesh),
                soup(triangulated(cloud, {.projection = projection}).mesh));
    }
  }
}

TEST(TriangulateDelaunay, KeepsOfPointsOnOnePlaceTheNearestAndOfThoseTheFirst) {
  PointCloud cloud;
  cloud.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -2}, {0, 0, 3}, {0, 0, 3}, {1, 0, -1}};
  cloud.attributes.observations = {0, 1, 2, 3, 4, 5, 6};
  const Triangulation above = triangulated(cloud, {.projection = Projection::z});
  EXPECT_EQ(above.report.duplicate_points, 4u);
  EXPECT_EQ(above.report.unused_points, 4u);
  EXPECT_EQ(above.mesh.attributes.observations, (std::vector<std::uint32_t>{1, 2, 4}));
  cloud.viewpoint = Vec3d{0, 0, -10};
  const Triangulation below = triangulated(cloud, {.projection = Projection::z});
  EXPECT_EQ(below.mesh.attributes.observations, (std::vector<std::uint32_t>{2, 3, 6}));
  const Triangulation seen = triangulated(cloud, {.projection = Projection::view});
  EXPECT_EQ(seen.report.duplicate_points, 3u);  // all that is on the z axis but the nearest
  EXPECT_EQ(seen.mesh.positions.front(), (Vec3f{1, 0, 0}));
}

TEST(TriangulateDelaunay, DropsLongEdgesAndSteepTriangles) {
  PointCloud steps = lattice(10, 10);
  for (Vec3f& p : steps.positions) p.z = p.x > 4 ? 1 : 0;
  const auto count = [&](const DelaunayParams& params) {
    return triangulated(steps, params).mesh.triangles.size();
  };
  const Projection z = Projection::z;
  EXPECT_EQ(count({.projection = z}), 2u * 81);
  EXPECT_EQ(count({.projection = z, .max_edge = 1.5}), 2u * 72);  // the step's diagonals are longer
  EXPECT_EQ(count({.projection = z, .max_edge = 1.8}), 2u * 81);
  const double degrees = std::numbers::pi / 180;
  EXPECT_EQ(count({.projection = z, .max_angle = 44.9 * degrees}), 2u * 72);
  EXPECT_EQ(count({.projection = z, .max_angle = 45.1 * degrees}), 2u * 81);
}

TEST(TriangulateDelaunay, CarriesAttributesAndSkipsMissingPixels) {
  PointCloud cloud = lattice(6, 5);
  cloud.grid = GridSize{6, 5};
  cloud.frame.origin = {100, 0, 0};
  for (std::uint32_t i = 0; i < 30; ++i) cloud.attributes.observations.push_back(i);
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  cloud.positions[0] = cloud.positions[14] = {kNone, kNone, kNone};
  const Triangulation result = triangulated(cloud);
  EXPECT_EQ(result.report.points, 28u);
  EXPECT_EQ(result.mesh.positions.size(), 28u);
  EXPECT_EQ(result.mesh.frame, cloud.frame);
  for (std::size_t v = 0; v < result.mesh.positions.size(); ++v)
    EXPECT_EQ(result.mesh.positions[v], cloud.positions[result.mesh.attributes.observations[v]]);
  EXPECT_EQ(topology(result.mesh).euler_number, 1);
}

TEST(TriangulateDelaunay, TakesTooFewPointsAndPointsInOnePlace) {
  PointCloud cloud;
  for (std::size_t count = 0; count < 3; ++count) {
    EXPECT_TRUE(triangulated(cloud).mesh.triangles.empty());
    EXPECT_EQ(triangulated(cloud).report.unused_points, count);
    cloud.positions.push_back({static_cast<float>(count), 1, 2});
  }
  cloud.positions.assign(100, {1, 2, 3});
  EXPECT_TRUE(triangulated(cloud).mesh.triangles.empty());
  EXPECT_EQ(triangulated(cloud).report.duplicate_points, 99u);
}

TEST(TriangulateDelaunay, RefusesAViewThatCannotBe) {
  PointCloud cloud = sheet(100, 5);
  const DelaunayParams view{.projection = Projection::view};
  EXPECT_EQ(triangulate_delaunay(cloud, view).error().code, ErrorCode::bad_geometry);
  cloud.viewpoint = Vec3d{0.5, 0.5, 1};
  EXPECT_TRUE(triangulate_delaunay(cloud, view));
  cloud.positions.push_back({0.5, 0.5, 2});
  const auto behind = triangulate_delaunay(cloud, view);
  ASSERT_FALSE(behind);
  EXPECT_EQ(behind.error().code, ErrorCode::bad_geometry);
  EXPECT_NE(behind.error().message.find("1 of 101 points"), std::string::npos);
  cloud.positions.back() = Vec3f(*cloud.viewpoint);
  EXPECT_FALSE(triangulate_delaunay(cloud, view));
}

}  // namespace
}  // namespace burnish
