#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "burnish/core/gather.h"
#include "burnish/core/point_cloud.h"
#include "burnish/core/triangle_mesh.h"
#include "burnish/shapes/shapes.h"

namespace burnish {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

Attributes every_attribute(std::size_t count) {
  Attributes all;
  for (std::size_t i = 0; i < count; ++i) {
    const auto n = static_cast<float>(i);
    all.normals.push_back({n, 0, 1});
    all.colors.push_back({static_cast<std::uint8_t>(i), 1, 2, 3});
    all.sigma.push_back(n / 8);
    all.noise.push_back({{1, 0, 0}, n, n / 4});
    all.observations.push_back(static_cast<std::uint32_t>(10 * i));
    all.origin.push_back(i % 2 == 0 ? Origin::seen : Origin::invented);
  }
  all.channels.push_back({"short", std::vector<std::int16_t>(count, 5)});
  all.channels.push_back({"number", std::vector<double>(count, 0.5)});
  return all;
}

template <class Geometry>
std::string refusal(const Geometry& geometry) {
  const auto sound = check(geometry);
  if (sound) return "accepted";
  EXPECT_EQ(sound.error().code, ErrorCode::bad_geometry);
  return sound.error().message;
}

TEST(CheckMesh, AcceptsWhatIsSoundAndNothing) {
  TriangleMesh mesh = make_sphere(1, 1);
  mesh.attributes = every_attribute(mesh.positions.size());
  EXPECT_EQ(refusal(mesh), "accepted");
  EXPECT_EQ(refusal(TriangleMesh{}), "accepted");
}

TEST(CheckMesh, NamesTheFirstOffender) {
  TriangleMesh mesh = make_grid(1, 1);
  mesh.triangles[1][2] = 4;
  EXPECT_EQ(refusal(mesh), "triangle 1 names vertex 4 of 4");
  mesh = make_grid(1, 1);
  mesh.positions[2].z = HUGE_VALF;
  EXPECT_EQ(refusal(mesh), "vertex 2 is not finite");
}

TEST(CheckMesh, NamesTheAttributeOfAnotherLength) {
  for (const char* name :
       {"normals", "colors", "sigma", "noise", "observations", "origin", "short", "number"}) {
    TriangleMesh mesh = make_grid(1, 1);
    mesh.attributes = every_attribute(4);
    const std::string which = name;
    if (which == "normals") mesh.attributes.normals.pop_back();
    if (which == "colors") mesh.attributes.colors.pop_back();
    if (which == "sigma") mesh.attributes.sigma.pop_back();
    if (which == "noise") mesh.attributes.noise.pop_back();
    if (which == "observations") mesh.attributes.observations.pop_back();
    if (which == "origin") mesh.attributes.origin.pop_back();
    if (which == "short") mesh.attributes.channels[0].values = std::vector<std::int16_t>(3);
    if (which == "number") mesh.attributes.channels[1].values = std::vector<double>(3);
    EXPECT_EQ(refusal(mesh), "attribute '" + which + "' has 3 values for 4 vertices");
  }
}

TEST(CheckCloud, OnlyAGridMayHoldMissingPixels) {
  PointCloud cloud;
  cloud.positions = {{0, 0, 1}, {kNaN, kNaN, kNaN}, {1, 0, 1}, {1, 1, 1}};
  EXPECT_EQ(refusal(cloud), "point 1 is not finite");
  cloud.grid = GridSize{2, 2};
  EXPECT_EQ(refusal(cloud), "accepted");
  cloud.grid = GridSize{3, 2};
  EXPECT_EQ(refusal(cloud), "the grid is 3 x 2 for 4 points");
  cloud.grid = GridSize{0x10000, 0x10000};  // 2^32 cells, which is 0 in 32 bits
  cloud.positions.clear();
  EXPECT_NE(refusal(cloud), "accepted");
}

TEST(Gather, TakesTheElementsAskedForInThatOrder) {
  const Attributes all = every_attribute(5);
  const std::vector<std::uint32_t> kept{4, 1, 1};
  const Attributes some = gather(all, kept);
  EXPECT_EQ(some.normals, (std::vector<Vec3f>{{4, 0, 1}, {1, 0, 1}, {1, 0, 1}}));
  EXPECT_EQ(some.noise, (std::vector<PointNoise>{all.noise[4], all.noise[1], all.noise[1]}));
  EXPECT_EQ(some.observations, (std::vector<std::uint32_t>{40, 10, 10}));
  EXPECT_EQ(some.origin, (std::vector<Origin>{Origin::seen, Origin::invented, Origin::invented}));
  EXPECT_TRUE(check_lengths(some, 3));
  EXPECT_EQ(some.channels[0].name, "short");
  EXPECT_TRUE(gather(Attributes{}, kept) == Attributes{});
}

TEST(PointCloud, SelectAndWithoutMissingLeaveTheGrid) {
  PointCloud cloud;
  cloud.positions = {{0, 0, 1}, {kNaN, kNaN, kNaN}, {1, 0, 1}, {1, 1, 1}};
  cloud.grid = GridSize{2, 2};
  cloud.viewpoint = Vec3d{1, 2, 3};
  cloud.attributes = every_attribute(4);
  const PointCloud finite = without_missing(cloud);
  EXPECT_EQ(finite.positions, (std::vector<Vec3f>{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}}));
  EXPECT_EQ(finite.attributes.observations, (std::vector<std::uint32_t>{0, 20, 30}));
  EXPECT_FALSE(finite.grid);
  EXPECT_EQ(finite.viewpoint, cloud.viewpoint);
  EXPECT_TRUE(check(finite));
  EXPECT_EQ(select(cloud, {3, 0}).positions, (std::vector<Vec3f>{{1, 1, 1}, {0, 0, 1}}));
}

TEST(WithoutUnusedVertices, KeepsTheOrderOfTheOthers) {
  TriangleMesh mesh;
  mesh.positions = {{9, 0, 0}, {1, 0, 0}, {9, 1, 0}, {2, 0, 0}, {3, 1, 0}};
  mesh.triangles = {{4, 1, 3}};
  mesh.attributes = every_attribute(5);
  const TriangleMesh tidy = without_unused_vertices(mesh);
  EXPECT_EQ(tidy.positions, (std::vector<Vec3f>{{1, 0, 0}, {2, 0, 0}, {3, 1, 0}}));
  EXPECT_EQ(tidy.triangles, (std::vector<Triangle>{{2, 0, 1}}));
  EXPECT_EQ(tidy.attributes.observations, (std::vector<std::uint32_t>{10, 30, 40}));
}

TEST(WithoutUnusedVertices, KeepsOwnersOfTriangles) {
  TriangleMesh mesh;
  mesh.positions = {{9, 0, 0}, {1, 0, 0}, {9, 1, 0}, {2, 0, 0}, {3, 1, 0}};
  mesh.triangles = {{4, 1, 3}};
  mesh.triangle_attributes = {{Origin::invented}, {2}};
  const TriangleMesh tidy = without_unused_vertices(mesh);
  EXPECT_EQ(tidy.positions, (std::vector<Vec3f>{{1, 0, 0}, {9, 1, 0}, {2, 0, 0}, {3, 1, 0}}));
  EXPECT_EQ(tidy.triangle_attributes.owner, (std::vector<std::uint32_t>{1}));
  EXPECT_EQ(tidy.triangle_attributes.origin, (std::vector<Origin>{Origin::invented}));
}

TEST(TriangleAttributes, AreAsLongAsThereAreTriangles) {
  TriangleMesh mesh = make_box({1, 1, 1});
  EXPECT_TRUE(check(mesh));
  mesh.triangle_attributes.origin.assign(mesh.triangles.size() - 1, Origin::seen);
  EXPECT_EQ(check(mesh).error().code, ErrorCode::bad_geometry);
  mesh.triangle_attributes.origin.clear();
  mesh.triangle_attributes.owner.assign(mesh.triangles.size(), 0);
  EXPECT_TRUE(check(mesh));
  mesh.triangle_attributes.owner[5] = 8;
  EXPECT_EQ(check(mesh).error().code, ErrorCode::bad_geometry);
}

TEST(KeepTriangles, KeepsWhatIsKnownOfThem) {
  TriangleMesh mesh = make_box({1, 1, 1});
  const std::vector<Triangle> all = mesh.triangles;
  for (std::uint32_t t = 0; t < all.size(); ++t) {
    mesh.triangle_attributes.owner.push_back(all[t][1]);
  }
  keep_triangles(mesh, std::vector<std::uint32_t>{7, 2});
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{all[7], all[2]}));
  EXPECT_EQ(mesh.triangle_attributes.owner, (std::vector<std::uint32_t>{all[7][1], all[2][1]}));
  EXPECT_TRUE(mesh.triangle_attributes.origin.empty());
}

TEST(VertexNormals, OfASpherePointOutwards) {
  const TriangleMesh sphere = make_sphere(2, 3);
  const auto normals = vertex_normals(sphere);
  for (std::size_t v = 0; v < normals.size(); ++v) {
    EXPECT_NEAR(norm(Vec3d(normals[v])), 1, 1e-6);
    // A vertex sees its ring under half an edge length over the radius at most.
    EXPECT_GT(dot(Vec3d(normals[v]), normalized(Vec3d(sphere.positions[v]))), 0.999);
  }
}

TEST(VertexNormals, AreZeroWhereThereIsNoArea) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 5, 5}};
  mesh.triangles = {{0, 1, 2}};
  for (const Vec3f& normal : vertex_normals(mesh)) EXPECT_EQ(normal, Vec3f{});
}

TEST(AreaVector, IsTwiceTheAreaAlongTheNormal) {
  TriangleMesh mesh;
  mesh.positions = {{1, 1, 1}, {4, 1, 1}, {1, 3, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
  EXPECT_EQ(area_vector(mesh, 0), (Vec3d{0, 0, 6}));
  EXPECT_EQ(area_vector(mesh, 1), (Vec3d{0, 0, -6}));
}

}  // namespace
}  // namespace burnish
