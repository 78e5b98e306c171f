#include "burnish/spatial/ray_caster.h"

#include <gtest/gtest.h>

#include "burnish/base/random.h"

namespace burnish {
namespace {

/// The unit cube around the origin, two triangles a side, counter-clockwise from outside.
TriangleMesh cube() {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.positions.push_back({i & 1 ? .5f : -.5f, i & 2 ? .5f : -.5f, i & 4 ? .5f : -.5f});
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

Vec3d random_direction(Random& random) {
  Vec3d v;
  for (std::size_t axis = 0; axis < 3; ++axis) v[axis] = random.normal();
  return normalized(v);
}

TEST(RayCaster, GivesTheDistanceToACubeInDouble) {
  const RayCaster caster(cube());
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d from = 3.0 * random_direction(random);
    const Vec3d towards = normalized(0.3 * random_direction(random) - from);
    // The slab test: the latest entry over the three pairs of sides.
    double entry = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double side = towards[axis] > 0 ? -0.5 : 0.5;
      entry = std::max(entry, (side - from[axis]) / towards[axis]);
    }
    const auto hit = caster.cast(from, towards);
    ASSERT_TRUE(hit);
    // A dozen operations on numbers of about 3, each rounded to 2^-53.
    EXPECT_NEAR(hit->distance, entry, 1e-14);
  }
}

TEST(RayCaster, BarycentricCoordinatesGiveThePointHit) {
  const TriangleMesh mesh = cube();
  const RayCaster caster(mesh);
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d from = 3.0 * random_direction(random);
    const Vec3d towards = normalized(-from);
    const auto hit = caster.cast(from, towards);
    ASSERT_TRUE(hit);
    const Triangle t = mesh.triangles[hit->triangle];
    const Vec3d point = (1 - hit->u - hit->v) * Vec3d(mesh.positions[t[0]]) +
                        hit->u * Vec3d(mesh.positions[t[1]]) + hit->v * Vec3d(mesh.positions[t[2]]);
    EXPECT_LT(norm(point - (from + hit->distance * towards)), 1e-14);
  }
}

TEST(RayCaster, NothingSlipsThroughEdgesAndVertices) {
  const TriangleMesh mesh = cube();
  const RayCaster caster(mesh);
  Random random(3);
  for (int i = 0; i < 20000; ++i) {
    const Vec3d from = 3.0 * random_direction(random);
    const Triangle t = mesh.triangles[random.below(12)];
    const double share = i % 3 == 0 ? 0 : random.uniform();
    const Vec3d target =
        (1 - share) * Vec3d(mesh.positions[t[0]]) + share * Vec3d(mesh.positions[t[1]]);
    // Pulled inwards by less than what single precision resolves over the distance.
    ASSERT_TRUE(caster.cast(from, normalized((1 - 1e-6) * target - from))) << i;
  }
}

TEST(RayCaster, OfTrianglesThatShareThePointTheSmallestIndexIsNamed) {
  TriangleMesh mesh = cube();
  const RayCaster caster(mesh);
  // The diagonal of side z = +0.5 runs through the z axis; its triangles are 2 and 3.
  const auto hit = caster.cast({0, 0, 3}, {0, 0, -1});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->triangle, 2u);
  EXPECT_EQ(hit->distance, 2.5);
}

TEST(RayCaster, MissesWhatIsBehindOrBeside) {
  const RayCaster caster(cube());
  EXPECT_FALSE(caster.cast({0, 0, 3}, {0, 0, 1}));
  EXPECT_FALSE(caster.cast({0.6, 0, 3}, {0, 0, -1}));
}

TEST(RayCaster, AMeshWithoutTrianglesIsNeverHit) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}};
  EXPECT_FALSE(RayCaster(mesh).cast({0, 0, 3}, {0, 0, -1}));
}

TEST(RayCaster, OutlivesTheMesh) {
  auto mesh = std::make_unique<TriangleMesh>(cube());
  RayCaster first(*mesh);
  mesh.reset();
  const RayCaster caster = std::move(first);
  EXPECT_TRUE(caster.cast({0.1, 0.2, 3}, {0, 0, -1}));
}

}  // namespace
}  // namespace burnish
