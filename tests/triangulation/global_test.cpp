#include "burnish/triangulation/global.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "burnish/base/random.h"
#include "burnish/core/gather.h"
#include "burnish/core/topology.h"
#include "burnish/io/geometry_file.h"
#include "burnish/spatial/neighbour_grid.h"
#include "burnish/triangulation/local_fans.h"
#include "burnish/triangulation/triangle_gap.h"
#include "support/test_data.h"
#include "support/threads.h"

namespace burnish {
namespace {

using test::with_threads;

Vec3d random_offset(Random& random, double size) {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return Vec3d{x, y, z} * size;
}

/// Points spread evenly over a unit sphere, each moved by `noise` of their spacing along each axis.
PointCloud sphere(std::size_t count, double noise, std::uint64_t seed) {
  Random random(seed);
  const double spacing = std::sqrt(4 * std::numbers::pi / static_cast<double>(count));
  PointCloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1 - 2 * (static_cast<double>(i) + .5) / static_cast<double>(count);
    const double angle = static_cast<double>(i) * std::numbers::pi * (3 - std::sqrt(5.0));
    const double r = std::sqrt(1 - z * z);
    const Vec3d p{r * std::cos(angle), r * std::sin(angle), z};
    cloud.positions.push_back(Vec3f(p + random_offset(random, noise * spacing)));
  }
  return cloud;
}

PointCloud torus(std::size_t around, std::size_t across, double noise, std::uint64_t seed) {
  Random random(seed);
  PointCloud cloud;
  for (std::size_t i = 0; i < around * across; ++i) {
    const double u =
        2 * std::numbers::pi * static_cast<double>(i / across) / static_cast<double>(around);
    const double v =
        2 * std::numbers::pi * static_cast<double>(i % across) / static_cast<double>(across);
    const double r = 1 + .4 * std::cos(v);
    const Vec3d p{r * std::cos(u), r * std::sin(u), .4 * std::sin(v)};
    cloud.positions.push_back(Vec3f(p + random_offset(random, noise)));
  }
  return cloud;
}

PointCloud plane(int width, int height, float spacing) {
  PointCloud cloud;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      cloud.positions.push_back(
          {spacing * static_cast<float>(x), spacing * static_cast<float>(y), 0});
    }
  }
  return cloud;
}

void expect_oriented_manifold(const TriangleMesh& mesh) {
  const Topology t = topology(mesh);
  EXPECT_TRUE(check(mesh));
  EXPECT_TRUE(t.oriented());
  EXPECT_EQ(t.non_manifold_vertices, 0u);
  EXPECT_EQ(t.degenerate_triangles, 0u);
  EXPECT_EQ(t.duplicate_triangles, 0u);
  EXPECT_EQ(t.unused_vertices, 0u);
}

constexpr Agreement kBoth[] = {Agreement::vote, Agreement::front};

TEST(TriangulateGlobal, ClosesASphereThroughAllPoints) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    for (const double noise : {0.0, 0.05, 0.1}) {
      const auto result = triangulate_global(
          sphere(2000, noise, seed), {.agreement = seed % 2 ? Agreement::vote : Agreement::front});
      ASSERT_TRUE(result);
      expect_oriented_manifold(result->mesh);
      const Topology t = topology(result->mesh);
      EXPECT_TRUE(t.closed()) << "noise " << noise << " seed " << seed;
      EXPECT_EQ(t.euler_number, 2);
      EXPECT_EQ(t.components, 1u);
      EXPECT_EQ(result->report.unused_points, 0u);
    }
  }
}

TEST(TriangulateGlobal, ClosesARegularTorusOnWhichFansDisagree) {
  for (const Agreement agreement : kBoth) {
    const auto result = triangulate_global(torus(300, 120, 0, 1), {.agreement = agreement});
    ASSERT_TRUE(result);
    expect_oriented_manifold(result->mesh);
    EXPECT_TRUE(topology(result->mesh).closed());
    EXPECT_EQ(topology(result->mesh).euler_number, 0);
    EXPECT_EQ(result->report.unused_points, 0u);
  }
}

TEST(TriangulateGlobal, ClosesATorus) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto result = triangulate_global(torus(90, 36, .005, seed));
    ASSERT_TRUE(result);
    expect_oriented_manifold(result->mesh);
    const Topology t = topology(result->mesh);
    EXPECT_TRUE(t.closed());
    EXPECT_EQ(t.euler_number, 0);
    EXPECT_EQ(t.components, 1u);
  }
}

TEST(TriangulateGlobal, LooksOutwards) {
  const auto result = triangulate_global(sphere(500, 0.05, 1));
  ASSERT_TRUE(result);
  double volume = 0;
  for (std::size_t t = 0; t < result->mesh.triangles.size(); ++t) {
    volume += dot(Vec3d(result->mesh.positions[result->mesh.triangles[t][0]]),
                  area_vector(result->mesh, t)) /
              6;
  }
  EXPECT_NEAR(volume, 4 * std::numbers::pi / 3, .1);
}

TEST(TriangulateGlobal, FillsARegularGridWhereAllSquaresAreCocircular) {
  for (const float spacing : {1.f, .001f, .1f}) {
    const auto result = triangulate_global(plane(23, 17, spacing));
    ASSERT_TRUE(result);
    expect_oriented_manifold(result->mesh);
    EXPECT_EQ(result->mesh.triangles.size(), 2u * 22 * 16);
    EXPECT_EQ(topology(result->mesh).euler_number, 1);
    EXPECT_EQ(result->report.invented_triangles, 0u);
  }
}

TEST(TriangulateGlobal, KeepsTwoSheetsApartThatAreNearerThanTheSpacing) {
  PointCloud cloud;
  Random random(4);
  for (const float side : {1.f, -1.f}) {
    for (const Vec3f& p : plane(20, 20, 1).positions) {
      const double x = random.uniform(-.2, .2), y = random.uniform(-.2, .2);
      cloud.positions.push_back(p + Vec3f(Vec3d{x, y, side * .2}));
      cloud.attributes.normals.push_back({0, 0, side});
    }
  }
  const auto result = triangulate_global(cloud);
  ASSERT_TRUE(result);
  expect_oriented_manifold(result->mesh);
  for (std::size_t t = 0; t < result->mesh.triangles.size(); ++t) {
    const Triangle& corners = result->mesh.triangles[t];
    for (const std::uint32_t v : corners) {
      EXPECT_EQ(result->mesh.positions[v].z, result->mesh.positions[corners[0]].z);
    }
    EXPECT_GT(area_vector(result->mesh, t).z * result->mesh.positions[corners[0]].z, 0);
  }
  EXPECT_EQ(topology(result->mesh).components, 2u);
}

TEST(TriangulateGlobal, ClosesASphereUnderNoiseOfATenthOfItsVolume) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto result = triangulate_global(sphere(20000, .3, seed));
    ASSERT_TRUE(result);
    expect_oriented_manifold(result->mesh);
    EXPECT_TRUE(topology(result->mesh).closed()) << "seed " << seed;
    EXPECT_EQ(topology(result->mesh).euler_number, 2);
    // Points lie up to three spacings inside each other: one in a thousand has no place.
    EXPECT_LE(result->report.unused_points, 20u);
  }
}

/// The triangles as positions, each from its smallest corner, sorted.
std::vector<std::array<std::array<float, 3>, 3>> as_positions(const TriangleMesh& mesh) {
  std::vector<std::array<std::array<float, 3>, 3>> result;
  for (const Triangle& t : mesh.triangles) {
    std::array<std::array<float, 3>, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3f& p = mesh.positions[t[i]];
      corners[i] = {p.x, p.y, p.z};
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    result.push_back(corners);
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// The part of `mesh` whose triangles have the origin.
TriangleMesh of_origin(TriangleMesh mesh, Origin origin) {
  std::vector<std::uint32_t> kept;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.triangle_attributes.origin[t] == origin) kept.push_back(t);
  }
  keep_triangles(mesh, kept);
  return mesh;
}

TEST(TriangulateGlobal, MarksWhatClosesAHoleAsInvented) {
  PointCloud cloud;  // a hole of 4 x 4, too wide for a measured triangle
  for (const Vec3f& p : plane(30, 30, 1).positions) {
    if (std::max(std::abs(p.x - 15), std::abs(p.y - 15)) > 1.5f) cloud.positions.push_back(p);
  }
  for (const Agreement agreement : kBoth) {
    GlobalParams params{.agreement = agreement, .max_gap = 0.8, .hole_edges = 0};
    const auto open = triangulate_global(cloud, params);
    params.hole_edges = 16;
    const auto closed = triangulate_global(cloud, params);
    ASSERT_TRUE(open && closed);
    expect_oriented_manifold(closed->mesh);
    EXPECT_EQ(topology(open->mesh).boundary_loops, 2u);
    EXPECT_EQ(topology(closed->mesh).boundary_loops, 1u);
    EXPECT_EQ(open->report.invented_triangles, 0u);
    EXPECT_EQ(closed->report.invented_triangles,
              closed->mesh.triangles.size() - open->mesh.triangles.size());
    EXPECT_EQ(as_positions(of_origin(closed->mesh, Origin::seen)), as_positions(open->mesh));
  }
}

TEST(TriangulateGlobal, SpansNoGapOfMoreThanTwoSpacings) {
  // A sphere with round gaps of three to six spacings.
  constexpr std::size_t kPoints = 4000;
  const double spacing_of_all = std::sqrt(4 * std::numbers::pi / kPoints);
  Random random(11);
  std::vector<Vec3d> centres;
  for (int i = 0; i < 30; ++i) centres.push_back(normalized(random_offset(random, 1)));
  PointCloud cloud;
  for (const Vec3f& p : sphere(kPoints, 0, 1).positions) {
    std::size_t gap = 0;
    const auto inside = [&](std::size_t i) {
      return norm(Vec3d(p) - centres[i]) < (1.5 + 0.05 * static_cast<double>(i)) * spacing_of_all;
    };
    while (gap < centres.size() && !inside(gap)) ++gap;
    if (gap < centres.size()) continue;
    cloud.positions.push_back(p);
    cloud.attributes.normals.push_back(p);
  }
  const NeighbourGrid grid(cloud.positions);
  NeighbourLists neighbours;
  Fans fans;
  ASSERT_TRUE(grid.nearest_of_all(17, {}, neighbours));
  ASSERT_TRUE(
      build_fans(cloud.positions, cloud.attributes.normals, grid, neighbours, {}, {}, fans));
  std::map<std::array<float, 3>, double> spacing;
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    const Vec3f& p = cloud.positions[i];
    spacing[{p.x, p.y, p.z}] = fans.spacing(i);
  }
  for (const Agreement agreement : kBoth) {
    const auto result = triangulate_global(cloud, {.agreement = agreement});
    ASSERT_TRUE(result);
    double widest = 0;
    for (const Triangle& t : result->mesh.triangles) {
      double largest = 0;
      for (const std::uint32_t v : t) {
        const Vec3f& p = result->mesh.positions[v];
        largest = std::max(largest, spacing.at({p.x, p.y, p.z}));
      }
      widest = std::max(widest, triangle_gap(Vec3d(result->mesh.positions[t[0]]),
                                             Vec3d(result->mesh.positions[t[1]]),
                                             Vec3d(result->mesh.positions[t[2]])) /
                                    largest);
    }
    EXPECT_LE(widest, 2);
    EXPECT_GE(widest, 1.2);
  }
}

TEST(TriangulateGlobal, LeavesNoShredsBesideTheSurface) {
  BURNISH_DATA_OR_SKIP(path, "stanford/buddha_photon.obj");
  const auto cloud = read_cloud(path);
  ASSERT_TRUE(cloud);
  for (const Agreement agreement : kBoth) {
    const auto result = triangulate_global(*cloud, {.agreement = agreement});
    ASSERT_TRUE(result);
    expect_oriented_manifold(result->mesh);
    EXPECT_EQ(topology(result->mesh).components, 1u);
  }
}

TEST(TriangulateGlobal, DoesNotCloseTheRimOfAnIsland) {
  for (const int side : {2, 3, 4}) {  // rims of 4, 8 and 12 edges
    const auto result = triangulate_global(plane(side, side, 1));
    ASSERT_TRUE(result);
    EXPECT_EQ(result->mesh.triangles.size(), 2u * (side - 1) * (side - 1));
    EXPECT_EQ(result->report.invented_triangles, 0u);
  }
}

TEST(TriangulateGlobal, SeesTheSurfaceOfLinesThatAreFarApart) {
  // A cylinder scanned along circles: neighbours on the circle are ten times nearer than the next
  // circle, so that sixteen of them are all on one line.
  PointCloud cloud;
  constexpr int kAround = 600;
  for (int row = 0; row < 20; ++row) {
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2 * std::numbers::pi * (i + .5 * (row % 2)) / kAround;
      cloud.positions.push_back(Vec3f(Vec3d{std::cos(angle), std::sin(angle), .1 * row}));
    }
  }
  const auto result = triangulate_global(cloud);
  ASSERT_TRUE(result);
  expect_oriented_manifold(result->mesh);
  const Topology t = topology(result->mesh);
  EXPECT_EQ(t.components, 1u);
  EXPECT_EQ(t.boundary_loops, 2u);
  EXPECT_EQ(result->report.unused_points, 0u);
}

TEST(TriangulateGlobal, FollowsAChangeOfDensity) {
  // Spacing grows tenfold from one side to the other.
  PointCloud cloud;
  Random random(5);
  for (double x = 1; x < 10; x *= 1.05) {
    for (double y = 0; y < 10; y += .05 * x) {
      const double dx = .01 * x * random.normal(), dy = .01 * x * random.normal();
      cloud.positions.push_back(Vec3f(Vec3d{x + dx, y + dy, 0}));
    }
  }
  const auto result = triangulate_global(cloud);
  ASSERT_TRUE(result);
  expect_oriented_manifold(result->mesh);
  EXPECT_EQ(topology(result->mesh).euler_number, 1);
  EXPECT_EQ(result->report.unused_points, 0u);
}

TEST(TriangulateGlobal, LeavesAHoleWiderThanTheSampling) {
  PointCloud cloud;
  for (const Vec3f& p : plane(30, 30, 1).positions) {
    if (norm(p - Vec3f{15, 15, 0}) > 6) cloud.positions.push_back(p);
  }
  const auto result = triangulate_global(cloud);
  ASSERT_TRUE(result);
  expect_oriented_manifold(result->mesh);
  EXPECT_EQ(topology(result->mesh).boundary_loops, 2u);
}

TEST(TriangulateGlobal, CarriesAttributesAndLeavesOutWhatItDoesNotUse) {
  PointCloud cloud = plane(5, 5, 1);
  cloud.positions.push_back({100, 100, 100});
  cloud.positions.push_back(cloud.positions[7]);
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    cloud.attributes.sigma.push_back(static_cast<float>(i));
    cloud.attributes.colors.push_back({static_cast<std::uint8_t>(i), 0, 0, 255});
  }
  const auto result = triangulate_global(cloud);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->report.points, 27u);
  EXPECT_EQ(result->report.unused_points, 2u);
  EXPECT_EQ(result->report.triangles, 32u);
  cloud.attributes.sigma.resize(25);
  cloud.attributes.colors.resize(25);
  EXPECT_EQ(result->mesh.attributes, cloud.attributes);
}

TEST(TriangulateGlobal, DoesNotDependOnTheOrderOfThePoints) {
  for (const auto& [cloud, agreement] : {std::pair{sphere(1500, .3, 6), Agreement::vote},
                                         {plane(20, 20, .1f), Agreement::vote},
                                         {sphere(1500, .3, 6), Agreement::front}}) {
    const GlobalParams params{.agreement = agreement};
    const auto result = triangulate_global(cloud, params);
    ASSERT_TRUE(result);
    std::vector<std::uint32_t> order(cloud.positions.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    Random random(7);
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    const auto permuted = triangulate_global(select(cloud, order), params);
    ASSERT_TRUE(permuted);
    EXPECT_EQ(as_positions(permuted->mesh), as_positions(result->mesh));
  }
}

TEST(TriangulateGlobal, IsTheSameForAnyNumberOfThreads) {
  const PointCloud cloud = sphere(5000, .3, 8);
  const auto one = triangulate_global(cloud, {}, with_threads(1));
  ASSERT_TRUE(one);
  expect_oriented_manifold(one->mesh);
  for (const int threads : {2, 3, 8}) {
    const auto many = triangulate_global(cloud, {}, with_threads(threads));
    ASSERT_TRUE(many);
    EXPECT_EQ(many->mesh, one->mesh);
  }
}

TEST(TriangulateGlobal, TakesDegenerateClouds) {
  PointCloud line, coincident;
  for (int i = 0; i < 50; ++i) {
    line.positions.push_back({static_cast<float>(i), static_cast<float>(2 * i), 0});
    coincident.positions.push_back({1, 2, 3});
  }
  for (const PointCloud& cloud : {PointCloud{}, line, coincident}) {
    const auto result = triangulate_global(cloud);
    ASSERT_TRUE(result);
    EXPECT_TRUE(result->mesh.triangles.empty());
    EXPECT_EQ(result->report.unused_points, cloud.positions.size());
  }
  for (const std::size_t count : {1u, 2u, 3u, 4u}) {
    PointCloud few;
    few.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    few.positions.resize(count);
    const auto result = triangulate_global(few);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->mesh.triangles.size(), count < 3 ? 0 : count - 2);
    expect_oriented_manifold(result->mesh);
  }
}

TEST(TriangulateGlobal, MakesAnOrientedManifoldOfAnyPointsOfASmallLattice) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Random random(seed);
    PointCloud cloud;
    const std::size_t count = 1 + random.below(250);
    const bool flat = seed % 3 == 0, with_normals = seed % 2 == 0;
    for (std::size_t i = 0; i < count; ++i) {
      Vec3f p;
      p.x = static_cast<float>(random.below(10));
      p.y = static_cast<float>(random.below(10));
      p.z = static_cast<float>(random.below(flat ? 2 : 10));
      cloud.positions.push_back(p);
      if (with_normals) {
        cloud.attributes.normals.push_back(normalized(Vec3f(random_offset(random, 1))));
      }
    }
    const auto result = triangulate_global(cloud, {.agreement = kBoth[seed % 4 / 2]});
    ASSERT_TRUE(result);
    expect_oriented_manifold(result->mesh);
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
}

TEST(TriangulateGlobal, RefusesWhatItCannotUse) {
  PointCloud cloud = plane(4, 4, 1);
  EXPECT_EQ(triangulate_global(cloud, {.neighbours = 0}).error().code, ErrorCode::invalid_argument);
  std::stop_source stop;
  stop.request_stop();
  Context context;
  context.stop = stop.get_token();
  EXPECT_EQ(triangulate_global(cloud, {}, context).error().code, ErrorCode::cancelled);
  cloud.positions[3].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(triangulate_global(cloud).error().code, ErrorCode::bad_geometry);
}

TEST(TriangulateGlobal, MakesOneWholeSurfaceOfTheBunnysPoints) {
  BURNISH_DATA_OR_SKIP(path, "stanford/bun_zipper.ply");
  const auto cloud = read_cloud(path);
  ASSERT_TRUE(cloud);
  const auto result = triangulate_global(*cloud);
  ASSERT_TRUE(result);
  expect_oriented_manifold(result->mesh);
  const Topology t = topology(result->mesh);
  EXPECT_EQ(t.components, 1u);
  EXPECT_LE(result->report.unused_points, 10u);
  EXPECT_LE(t.boundary_loops, 5u);    // the file's own mesh has 5 holes, one of three edges
  EXPECT_LE(t.boundary_edges, 223u);  // as many as the file's own mesh
  EXPECT_LE(result->report.invented_triangles, 100u);
}

}  // namespace
}  // namespace burnish
