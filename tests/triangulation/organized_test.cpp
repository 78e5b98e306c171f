#include "burnish/triangulation/organized.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "burnish/base/random.h"
#include "burnish/core/topology.h"
#include "support/threads.h"

namespace burnish {
namespace {

using test::with_threads;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr double kPixel = 1.0 / 585;  ///< Kinect v1's angle between two pixels, rad

/// The points that a camera in the origin, looking along z, sees: depth(column, row), NaN for none.
template <class Depth>
PointCloud image(std::uint32_t width, std::uint32_t height, float sigma, Depth depth) {
  PointCloud cloud;
  cloud.grid = GridSize{width, height};
  cloud.viewpoint = Vec3d{};
  for (std::uint32_t row = 0; row < height; ++row) {
    for (std::uint32_t column = 0; column < width; ++column) {
      const double z = depth(column, row);
      const double x = (column - width / 2.0) * kPixel, y = (row - height / 2.0) * kPixel;
      cloud.positions.push_back(Vec3f(Vec3d{x * z, y * z, z}));
      cloud.attributes.sigma.push_back(sigma);
    }
  }
  return cloud;
}

TEST(TriangulateOrganized, GivesTwoTrianglesForEachSquareOfAPlane) {
  const PointCloud cloud = image(20, 10, .001f, [](auto, auto) { return 2.0; });
  const auto result = triangulate_organized(cloud);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->mesh.triangles.size(), 2u * 19 * 9);
  EXPECT_EQ(result->report.unused_points, 0u);
  EXPECT_EQ(result->mesh.positions, cloud.positions);
  EXPECT_EQ(result->mesh.attributes, cloud.attributes);
  const Topology t = topology(result->mesh);
  EXPECT_TRUE(t.oriented());
  EXPECT_EQ(t.euler_number, 1);
}

TEST(TriangulateOrganized, FacesTheViewpointAlsoWhereTheGridIsAMirrorImage) {
  PointCloud cloud = image(6, 5, .001f, [](auto column, auto) { return 2.0 + .001 * column; });
  const auto towards_camera = [](const TriangleMesh& mesh) {
    std::size_t count = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) count += area_vector(mesh, t).z < 0;
    return count;
  };
  const auto seen = triangulate_organized(cloud);
  ASSERT_TRUE(seen);
  EXPECT_EQ(towards_camera(seen->mesh), seen->mesh.triangles.size());
  for (Vec3f& p : cloud.positions) p.x = -p.x;
  const auto mirrored = triangulate_organized(cloud);
  ASSERT_TRUE(mirrored);
  EXPECT_EQ(towards_camera(mirrored->mesh), mirrored->mesh.triangles.size());
}

TEST(TriangulateOrganized, CutsAStepOfFiveSigmaAndKeepsOneOfOneSigma) {
  const double sigma = .002;
  const auto step_of = [&](double sigmas) {
    return image(20, 10, static_cast<float>(sigma),
                 [&](auto column, auto) { return 1 + (column < 10 ? 0 : sigmas * sigma); });
  };
  const auto kept = triangulate_organized(step_of(1));
  ASSERT_TRUE(kept);
  EXPECT_EQ(topology(kept->mesh).components, 1u);
  const auto cut = triangulate_organized(step_of(5.1));
  ASSERT_TRUE(cut);
  EXPECT_EQ(topology(cut->mesh).components, 2u);
  EXPECT_EQ(cut->mesh.triangles.size(), 2u * 18 * 9);
}

TEST(TriangulateOrganized, KeepsASteepPlaneAndCutsOneSteeperThanTheAngle) {
  // A plane through (0, 0, 1) whose normal makes `angle` with the optical axis; hardly any noise.
  const auto tilted = [](double degrees) {
    const double slope = std::tan(degrees * std::numbers::pi / 180);
    return image(10, 10, 1e-6f,
                 [slope](auto column, auto) { return 1 / (1 - slope * (column - 5.0) * kPixel); });
  };
  EXPECT_EQ(triangulate_organized(tilted(75))->mesh.triangles.size(), 2u * 9 * 9);
  EXPECT_EQ(triangulate_organized(tilted(85))->mesh.triangles.size(), 0u);
}

TEST(TriangulateOrganized, KeepsAQuantisedWallWhole) {
  // Kinect v1 at 4 m: depth in steps of 46 mm, sigma 25 mm, neighbours up to two steps apart.
  Random random(1);
  const PointCloud cloud = image(
      64, 48, .025f, [&](auto, auto) { return 4 + .046 * static_cast<double>(random.below(3)); });
  const auto result = triangulate_organized(cloud);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->mesh.triangles.size(), 2u * 63 * 47);
}

TEST(TriangulateOrganized, LeavesOneTriangleWhereACornerIsMissing) {
  for (std::uint32_t missing = 0; missing < 4; ++missing) {
    const PointCloud cloud = image(2, 2, .001f, [&](std::uint32_t column, std::uint32_t row) {
      return row * 2 + column == missing ? double{kNan} : 1.0;
    });
    const auto result = triangulate_organized(cloud);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->mesh.triangles.size(), 1u);
    EXPECT_EQ(result->mesh.positions.size(), 3u);
    EXPECT_EQ(result->report.points, 3u);
    EXPECT_LT(area_vector(result->mesh, 0).z, 0);
  }
}

TEST(TriangulateOrganized, TakesTheShorterDiagonalAndTheFirstOfEqualOnes) {
  // A dent in one corner of a square: the diagonal that avoids it is the shorter one.
  PointCloud cloud = image(2, 2, 1.f, [](auto, auto) { return 1.0; });
  const auto level = triangulate_organized(cloud);
  EXPECT_EQ(level->mesh.triangles, (std::vector<Triangle>{{0, 2, 3}, {0, 3, 1}}));
  cloud.positions[3].z += .01f;
  const auto dented = triangulate_organized(cloud);
  EXPECT_EQ(dented->mesh.triangles, (std::vector<Triangle>{{0, 2, 1}, {1, 2, 3}}));
}

TEST(TriangulateOrganized, TakesImagesOfOneRowOneColumnAndNothing) {
  for (const GridSize size : {GridSize{0, 0}, GridSize{1, 1}, GridSize{7, 1}, GridSize{1, 7},
                              GridSize{0, 3}, GridSize{3, 0}}) {
    const auto result = triangulate_organized(
        image(size.width, size.height, .001f, [](auto, auto) { return 1.0; }));
    ASSERT_TRUE(result);
    EXPECT_TRUE(result->mesh.triangles.empty());
    EXPECT_EQ(result->report.unused_points, std::size_t{size.width} * size.height);
  }
}

/// The rule of organized.h word for word, one edge at a time; indices of pixels.
std::vector<Triangle> by_definition(const PointCloud& cloud, const OrganizedParams& params) {
  const auto joined = [&](std::uint32_t a, std::uint32_t b) {
    const Vec3d p(cloud.positions[a]), q(cloud.positions[b]);
    if (!is_finite(p) || !is_finite(q)) return false;
    const double step = std::abs(norm(p - *cloud.viewpoint) - norm(q - *cloud.viewpoint));
    const double sigma = std::hypot(cloud.attributes.sigma[a], cloud.attributes.sigma[b]);
    return step <= params.max_jump * sigma || step <= std::sin(params.max_angle) * norm(p - q);
  };
  const auto length = [&](std::uint32_t a, std::uint32_t b) {
    return squared_norm(Vec3d(cloud.positions[a]) - Vec3d(cloud.positions[b]));
  };
  std::vector<Triangle> triangles;
  const auto add = [&](const Triangle& t) {
    if (joined(t[0], t[1]) && joined(t[1], t[2]) && joined(t[2], t[0])) triangles.push_back(t);
  };
  const std::uint32_t width = cloud.grid->width;
  for (std::uint32_t a = 0; a + width < cloud.positions.size(); ++a) {
    const std::uint32_t b = a + 1, c = a + width, d = c + 1;
    if (b % width == 0) continue;
    const auto makes = [&](std::uint32_t p, std::uint32_t q) {  // a diagonal and a triangle with it
      const auto beside = [&](std::uint32_t r) { return joined(p, r) && joined(r, q); };
      const bool rises = p == b;
      return joined(p, q) && (beside(rises ? a : b) || beside(rises ? d : c));
    };
    const bool falls = makes(a, d), rises = makes(b, c);
    if (falls && (!rises || length(a, d) <= length(b, c))) {
      add({a, c, d});
      add({a, d, b});
    } else if (rises) {
      add({a, c, b});
      add({b, c, d});
    }
  }
  return triangles;
}

TEST(TriangulateOrganized, CutsWhatTheRuleCutsAndNothingElse) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    const PointCloud cloud = image(37, 50, .004f, [&](auto column, auto) {
      return random.below(10) == 0 ? double{kNan}
                                   : 1 + .02 * random.normal() + (column > 20 ? .1 : 0);
    });
    const OrganizedParams params{.max_jump = 1.5, .max_angle = 1.4};
    const auto expected = by_definition(cloud, params);
    const TriangleMesh mesh = triangulate_organized(cloud, params)->mesh;
    ASSERT_EQ(mesh.triangles.size(), expected.size());
    for (std::size_t t = 0; t < expected.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(mesh.positions[mesh.triangles[t][k]], cloud.positions[expected[t][k]]);
    }
  }
}

TEST(TriangulateOrganized, AssumesTheNoiseOfPointsWithoutSigma) {
  PointCloud cloud = image(20, 10, 0, [](auto column, auto) { return column < 10 ? 4.0 : 4.07; });
  cloud.attributes.sigma.clear();
  EXPECT_EQ(topology(triangulate_organized(cloud)->mesh).components, 1u);
  EXPECT_EQ(topology(triangulate_organized(cloud, {.assumed_noise = 0})->mesh).components, 2u);
}

TEST(TriangulateOrganized, IsTheSameForAnyNumberOfThreads) {
  Random random(2);
  const PointCloud cloud = image(160, 120, .01f, [&](auto, auto) {
    return random.below(20) == 0 ? double{kNan} : 2 + .02 * random.normal();
  });
  const auto one = triangulate_organized(cloud, {}, with_threads(1));
  for (const int threads : {2, 3, 8}) {
    const auto many = triangulate_organized(cloud, {}, with_threads(threads));
    EXPECT_EQ(many->mesh, one->mesh);
  }
  EXPECT_TRUE(topology(one->mesh).oriented());
}

TEST(TriangulateOrganized, RefusesACloudWithoutAGridAndStopsWhenCancelled) {
  PointCloud cloud = image(4, 4, .001f, [](auto, auto) { return 1.0; });
  std::stop_source stop;
  stop.request_stop();
  Context context;
  context.stop = stop.get_token();
  EXPECT_EQ(triangulate_organized(cloud, {}, context).error().code, ErrorCode::cancelled);
  EXPECT_EQ(triangulate_organized(cloud, {.max_jump = -1}).error().code,
            ErrorCode::invalid_argument);
  cloud.grid.reset();
  EXPECT_EQ(triangulate_organized(cloud).error().code, ErrorCode::bad_geometry);
}

}  // namespace
}  // namespace burnish
