#include "burnish/triangulation/fan_cloud.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "burnish/base/random.h"
#include "burnish/io/geometry_file.h"
#include "burnish/points/estimate_normals.h"
#include "burnish/triangulation/global.h"
#include "support/fan_geometry.h"
#include "support/test_data.h"

namespace burnish {
namespace {

using test::fan_angles;
using test::fan_votes;

constexpr double kPi = std::numbers::pi;

std::vector<Vec3f> random_sphere(std::size_t count, double noise = 0) {
  Random random(1);
  std::vector<Vec3f> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.normal(), y = random.normal(), z = random.normal();
    points.push_back(Vec3f(normalized(Vec3d{x, y, z}) * (1 + noise * random.normal())));
  }
  return points;
}

std::vector<Vec3f> lattice(int nx, int ny, int nz) {
  std::vector<Vec3f> points;
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) {
        points.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
      }
    }
  }
  return points;
}

FanCloud build(const std::vector<Vec3f>& points, FanVariant variant,
               const std::vector<Vec3f>& normals = {}) {
  return FanCloud::build(points, normals, {.variant = variant}).value();
}

std::size_t count(const FanCloud& cloud, FanState state) {
  std::size_t n = 0;
  for (std::uint32_t p = 0; p < cloud.size(); ++p) n += cloud.state(p) == state;
  return n;
}

/// Triangles in a row around a centre that turn by less than pi each and by no more than a full
/// turn together do not overlap. Angles carry the rounding of the fan's normal to float, 1e-7.
void expect_stars_without_overlap(const FanCloud& cloud) {
  const bool ring = cloud.params().variant == FanVariant::ring;
  const double limit = ring ? cloud.params().gap_angle + 2e-6 : kPi;
  for (std::uint32_t p = 0; p < cloud.size(); ++p) {
    const std::vector<double> angles = fan_angles(cloud, p);
    for (const double angle : angles) {
      ASSERT_GT(angle, 0) << "fan " << p << " folds back";
      ASSERT_LE(angle, limit) << "fan " << p;
    }
    const double sum = std::accumulate(angles.begin(), angles.end(), 0.0);
    ASSERT_LE(sum, 2 * kPi + 1e-5) << "fan " << p << " overlaps itself";
    const bool closed = cloud.state(p) == FanState::closed;
    ASSERT_EQ(closed, sum > 2 * kPi - 1e-5) << "fan " << p;
    ASSERT_EQ(angles.empty(), cloud.state(p) < FanState::open) << "fan " << p;
    const auto rim = cloud.rim(p);
    std::set<std::uint32_t> once(rim.begin(), rim.end());
    once.erase(Fan::kGap);
    const auto gaps = static_cast<std::size_t>(std::count(rim.begin(), rim.end(), Fan::kGap));
    ASSERT_EQ(once.size() + gaps, rim.size()) << "fan " << p << " meets a point twice";
    ASSERT_EQ(once.count(p), 0u);
  }
}

class FanCloudOf : public testing::TestWithParam<FanVariant> {
 protected:
  FanVariant variant() const { return GetParam(); }
};

TEST_P(FanCloudOf, ManyShapesIsStarsWithoutOverlap) {
  expect_stars_without_overlap(build(random_sphere(3000), variant()));
  expect_stars_without_overlap(build(random_sphere(3000, 0.02), variant()));
  expect_stars_without_overlap(build(lattice(30, 20, 1), variant()));
  expect_stars_without_overlap(build(lattice(10, 10, 10), variant()));
  std::vector<Vec3f> blob = random_sphere(2000, 0.5);
  expect_stars_without_overlap(build(blob, variant()));
}

TEST_P(FanCloudOf, TheBunnyIsStarsWithoutOverlap) {
  BURNISH_DATA_OR_SKIP(path, "stanford/bun_zipper.ply");
  const auto cloud = read_cloud(path);
  ASSERT_TRUE(cloud);
  expect_stars_without_overlap(build(cloud->positions, variant()));
}

TEST_P(FanCloudOf, AClosedSurfaceHasNoBoundary) {
  const FanCloud cloud = build(random_sphere(5000), variant());
  // A half plane without any of 24 neighbours has the probability 2^-24 * 24; a quarter of the
  // plane, 24 * (3/4)^23 = 0.03. The gaps that are left stand open.
  EXPECT_GT(count(cloud, FanState::closed), 4800u);
  EXPECT_EQ(count(cloud, FanState::closed) + count(cloud, FanState::open), 5000u);
}

TEST_P(FanCloudOf, ASquareLatticeIsOpenAtItsSidesOnly) {
  const FanCloud cloud = build(lattice(12, 9, 1), variant());
  for (std::uint32_t p = 0; p < cloud.size(); ++p) {
    const std::uint32_t x = p % 12, y = p / 12;
    const bool side = x == 0 || x == 11 || y == 0 || y == 8;
    EXPECT_EQ(cloud.state(p), side ? FanState::open : FanState::closed) << x << ' ' << y;
    const std::vector<double> angles = fan_angles(cloud, p);
    const double sum = std::accumulate(angles.begin(), angles.end(), 0.0);
    const bool corner = (x == 0 || x == 11) && (y == 0 || y == 8);
    EXPECT_NEAR(sum, corner ? kPi / 2 : side ? kPi : 2 * kPi, 1e-5) << x << ' ' << y;
  }
}

TEST_P(FanCloudOf, TheDirectionOfAGivenNormalDecides) {
  std::vector<Vec3f> points = lattice(8, 8, 1);
  const std::vector<Vec3f> up(points.size(), {0, 0, 1}), down(points.size(), {0, 0, -1});
  const FanCloud above = build(points, variant(), up), below = build(points, variant(), down);
  for (std::uint32_t p = 0; p < points.size(); ++p) {
    EXPECT_EQ(above.fan_normal(p).z, 1);
    EXPECT_EQ(below.fan_normal(p).z, -1);
    EXPECT_EQ(fan_angles(above, p).size(), fan_angles(below, p).size());
  }
  EXPECT_EQ(fan_votes(above), fan_votes(below));
}

TEST_P(FanCloudOf, TwoSheetsNearerThanTheSamplingStayTwoByTheirNormals) {
  std::vector<Vec3f> points = lattice(15, 15, 1), normals(points.size(), {0, 0, 1});
  const std::size_t lower = points.size();
  for (std::size_t i = 0; i < lower; ++i) {
    points.push_back(points[i] + Vec3f{0.4f, 0.3f, -0.2f});
    normals.push_back({0, 0, -1});
  }
  const FanCloud cloud = build(points, variant(), normals);
  for (const auto& [triangle, votes] : fan_votes(cloud)) {
    EXPECT_EQ(triangle[0] < lower, triangle[1] < lower);
    EXPECT_EQ(triangle[0] < lower, triangle[2] < lower);
  }
  EXPECT_EQ(count(cloud, FanState::closed), 2u * 13 * 13);
}

TEST_P(FanCloudOf, PointsThatCannotHaveAFanSaySo) {
  EXPECT_EQ(build({}, variant()).size(), 0u);
  EXPECT_EQ(build({{1, 2, 3}}, variant()).state(0), FanState::isolated);
  const FanCloud pair = build({{1, 2, 3}, {1, 2, 4}}, variant());
  EXPECT_EQ(count(pair, FanState::isolated), 2u);
  EXPECT_EQ(count(build(lattice(50, 1, 1), variant()), FanState::collinear), 50u);
  const FanCloud three = build({{0, 0, 0}, {1, 0, 0}, {0.4f, 0.9f, 0}}, variant());
  EXPECT_EQ(count(three, FanState::open), 3u);
  EXPECT_EQ(fan_votes(three).size(), 1u);
}

TEST_P(FanCloudOf, CoincidentPointsAreOnePoint) {
  const std::vector<Vec3f> single = lattice(9, 7, 1);
  std::vector<Vec3f> triple;
  for (const Vec3f& p : single) triple.insert(triple.end(), 3, p);
  const FanCloud one = build(single, variant()), three = build(triple, variant());
  EXPECT_EQ(count(three, FanState::duplicate), 2 * single.size());
  for (std::uint32_t p = 0; p < single.size(); ++p) {
    ASSERT_EQ(three.state(3 * p), one.state(p));
    ASSERT_EQ(three.rim(3 * p).size(), one.rim(p).size());
    for (std::size_t i = 0; i < one.rim(p).size(); ++i) {
      const std::uint32_t q = one.rim(p)[i];
      EXPECT_EQ(three.rim(3 * p)[i], q == Fan::kGap ? q : 3 * q);
    }
  }
}

TEST_P(FanCloudOf, ThreadsChangeNothing) {
  const std::vector<Vec3f> points = random_sphere(20000, 0.01);
  Context one, many;
  one.threads = 1;
  many.threads = 8;
  const FanCloud a = FanCloud::build(points, {}, {.variant = variant()}, one).value();
  const FanCloud b = FanCloud::build(points, {}, {.variant = variant()}, many).value();
  for (std::uint32_t p = 0; p < points.size(); ++p) {
    ASSERT_TRUE(std::equal(a.rim(p).begin(), a.rim(p).end(), b.rim(p).begin(), b.rim(p).end()));
    ASSERT_EQ(a.fan_normal(p), b.fan_normal(p));
  }
}

INSTANTIATE_TEST_SUITE_P(Variants, FanCloudOf,
                         testing::Values(FanVariant::ring, FanVariant::delaunay),
                         [](const auto& variant) {
                           return variant.param == FanVariant::ring ? "ring" : "delaunay";
                         });

/// The triangles that three fans share, as positions, and those of them that `mesh` lacks.
struct Shared {
  std::size_t count = 0, missing = 0;
};

Shared shared_by_three(const PointCloud& cloud) {
  using Place = std::array<float, 3>;
  std::map<Place, std::uint32_t> index;
  const auto place = [](const Vec3f& p) { return Place{p.x, p.y, p.z}; };
  for (auto p = static_cast<std::uint32_t>(cloud.positions.size()); p-- > 0;) {
    index[place(cloud.positions[p])] = p;
  }
  const TriangleMesh mesh = triangulate_global(cloud).value().mesh;
  std::set<Triangle> triangles;
  for (Triangle t : mesh.triangles) {
    for (std::uint32_t& v : t) v = index[place(mesh.positions[v])];
    triangles.insert(test::unordered(t));
  }
  Shared shared;
  const FanCloud fans = build(cloud.positions, FanVariant::delaunay, cloud.attributes.normals);
  for (const auto& [triangle, votes] : fan_votes(fans)) {
    shared.count += votes == 3;
    shared.missing += votes == 3 && triangles.count(triangle) == 0;
  }
  return shared;
}

TEST(FanCloud, TrianglesThatThreeFansShareAreInTheGlobalResult) {
  PointCloud cloud;
  cloud.positions = random_sphere(5000, 0.003);
  ASSERT_TRUE(estimate_normals(cloud));
  const Shared shared = shared_by_three(cloud);
  EXPECT_GT(shared.count, 8000u);
  EXPECT_EQ(shared.missing, 0u);
}

TEST(FanCloud, TrianglesThatThreeFansOfTheBunnyShareAreInTheGlobalResult) {
  BURNISH_DATA_OR_SKIP(path, "stanford/bun_zipper.ply");
  auto cloud = read_cloud(path);
  ASSERT_TRUE(cloud);
  ASSERT_TRUE(estimate_normals(*cloud));
  const Shared shared = shared_by_three(*cloud);
  EXPECT_GT(shared.count, 68000u);
  EXPECT_EQ(shared.missing, 0u);
}

TEST(FanCloud, DelaunayFansOfPlanarPointsAgree) {
  std::vector<Vec3f> points;
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const double x = random.uniform(), y = random.uniform();
    points.push_back(Vec3f(Vec3d{x, y, 0}));
  }
  std::size_t all = 0, three = 0;
  for (const auto& [triangle, votes] : fan_votes(build(points, FanVariant::delaunay))) {
    ++all;
    three += votes == 3;
  }
  // Only the slivers at the boundary of the square, about 4 * sqrt(2000) points, may disagree.
  EXPECT_GT(three, 3600u);
  EXPECT_LT(all - three, 400u);
}

TEST(FanCloud, RefusesWhatItCannotUse) {
  const std::vector<Vec3f> points = lattice(4, 4, 1);
  EXPECT_EQ(FanCloud::build(points, {}, {.k = 0}).error().code, ErrorCode::invalid_argument);
  EXPECT_EQ(FanCloud::build(points, lattice(2, 1, 1)).error().code, ErrorCode::bad_geometry);
  const std::vector<std::uint8_t> active(3, 1);
  EXPECT_EQ(FanCloud::build(points, {}, {}, {}, active).error().code, ErrorCode::bad_geometry);
  std::vector<Vec3f> bad = points;
  bad[5].x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(FanCloud::build(bad).error().code, ErrorCode::bad_geometry);
  std::stop_source stop;
  stop.request_stop();
  Context context;
  context.stop = stop.get_token();
  EXPECT_EQ(FanCloud::build(points, {}, {}, context).error().code, ErrorCode::cancelled);
}

TEST(FanCloud, RefusesEditsOfPointsThatAreNotThere) {
  FanCloud cloud = FanCloud::build(lattice(4, 4, 1)).value();
  EXPECT_EQ(cloud.add({0, std::numeric_limits<float>::infinity(), 0}).error().code,
            ErrorCode::bad_geometry);
  EXPECT_EQ(cloud.remove(16).error().code, ErrorCode::invalid_argument);
  EXPECT_TRUE(cloud.remove(3));
  EXPECT_EQ(cloud.remove(3).error().code, ErrorCode::invalid_argument);
  EXPECT_EQ(cloud.set_active(3, true).error().code, ErrorCode::invalid_argument);
  EXPECT_EQ(cloud.add({3, 0, 0}).value(), 3u);
  EXPECT_EQ(cloud.add({9, 9, 9}).value(), 16u);
}

}  // namespace
}  // namespace burnish
