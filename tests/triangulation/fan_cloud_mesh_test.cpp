#include "burnish/triangulation/fan_cloud_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "burnish/base/random.h"
#include "burnish/io/geometry_file.h"
#include "burnish/spatial/closest_point.h"
#include "support/bunny.h"
#include "support/fan_geometry.h"
#include "support/test_data.h"

namespace burnish {
namespace {

PointCloud lattice(int nx, int ny) {
  PointCloud cloud;
  for (int y = 0; y < ny; ++y) {
    for (int x = 0; x < nx; ++x) {
      cloud.positions.push_back({static_cast<float>(x), static_cast<float>(y), 0});
    }
  }
  return cloud;
}

PointCloud random_sphere(std::size_t count) {
  Random random(1);
  PointCloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.normal(), y = random.normal(), z = random.normal();
    cloud.positions.push_back(Vec3f(normalized(Vec3d{x, y, z})));
  }
  return cloud;
}

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) sum += norm(area_vector(mesh, t)) / 2;
  return sum;
}

/// Largest distance from the centres of true triangles to a mesh.
double widest_hole(const TriangleMesh& truth, const TriangleMesh& mesh) {
  const ClosestPoint closest(mesh);
  double widest = 0;
  for (const Triangle& t : truth.triangles) {
    const Vec3d centre = (Vec3d(truth.positions[t[0]]) + Vec3d(truth.positions[t[1]]) +
                          Vec3d(truth.positions[t[2]])) /
                         3.0;
    widest = std::max(widest, closest(centre).distance);
  }
  return widest;
}

double median_spacing(const std::vector<Vec3f>& points) {
  const NeighbourGrid grid(points);
  std::vector<Neighbour> found;
  std::vector<double> distances;
  for (const Vec3f& p : points) {
    grid.nearest(p, 2, found);
    distances.push_back(std::sqrt(found.back().squared_distance));
  }
  std::nth_element(distances.begin(), distances.begin() + distances.size() / 2, distances.end());
  return distances[distances.size() / 2];
}

class FanCloudMesh : public testing::TestWithParam<FanVariant> {
 protected:
  Triangulation draw(const PointCloud& cloud, FanDrawing drawn = FanDrawing::cover) const {
    FanCloudParams params;
    params.variant = GetParam();
    params.drawn = drawn;
    return triangulate_fan_cloud(cloud, params).value();
  }
};

TEST_P(FanCloudMesh, CoversALatticeOnce) {
  const Triangulation result = draw(lattice(31, 22));
  EXPECT_EQ(result.report.boundary_points, 2u * (31 + 22) - 4);
  const double whole = 30 * 21;
  if (GetParam() == FanVariant::delaunay) {
    EXPECT_NEAR(area(result.mesh), whole, 1e-3);
    EXPECT_EQ(result.mesh.triangles.size(), 2u * 30 * 21);
  } else {
    // Along the sides the nearest eight are not the adjacent ones, and rings overlap.
    EXPECT_GE(area(result.mesh), whole - 1e-3);
    EXPECT_LE(area(result.mesh), 1.2 * whole);
  }
}

TEST_P(FanCloudMesh, CoversASphereWithLittleOverlap) {
  const Triangulation result = draw(random_sphere(5000));
  const double whole = 4 * std::numbers::pi;
  // Fans of random points disagree in places, rings more than stars; flat triangles lose less than
  // a thousandth of the area.
  EXPECT_GT(area(result.mesh), 0.998 * whole);
  EXPECT_LT(area(result.mesh), (GetParam() == FanVariant::ring ? 1.6 : 1.1) * whole);
}

TEST_P(FanCloudMesh, LeavesNoHoleInTheBunny) {
  BURNISH_DATA_OR_SKIP(path, "stanford/bun_zipper.ply");
  const TriangleMesh bunny = test::read_bunny(path);
  PointCloud cloud;
  cloud.positions = bunny.positions;
  const Triangulation result = draw(cloud);
  EXPECT_LT(widest_hole(bunny, result.mesh), 2 * median_spacing(bunny.positions));
  EXPECT_LE(result.mesh.triangles.size(), 2.2 * static_cast<double>(bunny.positions.size()));
}

TEST_P(FanCloudMesh, TriangleBelongsToItsOwnersFanAndComesOnce) {
  const PointCloud cloud = random_sphere(3000);
  const Triangulation cover = draw(cloud), all = draw(cloud, FanDrawing::all);
  std::set<std::pair<std::uint32_t, Triangle>> of_fans;
  for (std::size_t t = 0; t < all.mesh.triangles.size(); ++t) {
    const Triangle& corners = all.mesh.triangles[t];
    const std::uint32_t owner = all.mesh.triangle_attributes.owner[t];
    EXPECT_TRUE(of_fans.emplace(owner, test::unordered(corners)).second);
  }
  std::set<Triangle> once;
  for (std::size_t t = 0; t < cover.mesh.triangles.size(); ++t) {
    const Triangle corners = test::unordered(cover.mesh.triangles[t]);
    EXPECT_TRUE(once.insert(corners).second) << "a triangle comes twice";
    EXPECT_TRUE(of_fans.count({cover.mesh.triangle_attributes.owner[t], corners}));
  }
  // By Euler's formula a mesh has two triangles a point and each is in three fans; rings of eight
  // neighbours and more have more.
  EXPECT_GE(all.mesh.triangles.size(), 5.9 * 3000);
  EXPECT_LE(once.size(), 3.0 * 3000);
}

TEST_P(FanCloudMesh, FacesOutwardsWithoutNormals) {
  const Triangulation result = draw(random_sphere(4000));
  std::size_t inwards = 0;
  for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t) {
    const Vec3d at(result.mesh.positions[result.mesh.triangles[t][0]]);
    inwards += dot(area_vector(result.mesh, t), at) <= 0;
  }
  // A sliver may be steeper to the sphere than its owner's plane.
  EXPECT_LE(inwards, result.mesh.triangles.size() / 1000);
}

TEST_P(FanCloudMesh, FacesTheViewpoint) {
  PointCloud cloud = lattice(10, 10);
  for (const double z : {5.0, -5.0}) {
    cloud.viewpoint = Vec3d{4, 4, z};
    const Triangulation result = draw(cloud);
    for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t) {
      EXPECT_GT(area_vector(result.mesh, t).z * z, 0);
    }
  }
}

TEST_P(FanCloudMesh, CountsWhatHasNoFan) {
  PointCloud cloud = lattice(6, 5);
  cloud.positions.push_back({2, 2, 0});
  cloud.positions.push_back({2, 2, 0});
  const Triangulation result = draw(cloud);
  EXPECT_EQ(result.report.points, 32u);
  EXPECT_EQ(result.report.duplicate_points, 2u);
  EXPECT_EQ(result.report.unused_points, 2u);
  EXPECT_EQ(result.report.isolated_points, 0u);
  EXPECT_EQ(result.mesh.positions.size(), 30u);
  EXPECT_TRUE(check(result.mesh));
}

TEST_P(FanCloudMesh, OfPointsWithoutASurfaceIsEmpty) {
  EXPECT_EQ(draw(PointCloud{}).report.points, 0u);
  EXPECT_EQ(draw(lattice(1, 1)).report.isolated_points, 1u);
  EXPECT_EQ(draw(lattice(2, 1)).report.isolated_points, 2u);
  EXPECT_EQ(draw(lattice(40, 1)).report.collinear_points, 40u);
  for (const PointCloud& cloud : {PointCloud{}, lattice(1, 1), lattice(2, 1), lattice(40, 1)}) {
    const Triangulation result = draw(cloud);
    EXPECT_TRUE(result.mesh.triangles.empty());
    EXPECT_TRUE(result.mesh.positions.empty());
    EXPECT_EQ(result.report.unused_points, cloud.positions.size());
  }
}

INSTANTIATE_TEST_SUITE_P(Variants, FanCloudMesh,
                         testing::Values(FanVariant::ring, FanVariant::delaunay),
                         [](const auto& variant) {
                           return variant.param == FanVariant::ring ? "ring" : "delaunay";
                         });

}  // namespace
}  // namespace burnish
