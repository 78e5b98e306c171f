#include "burnish/triangulation/adaptive_fan_cloud.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "burnish/base/random.h"
#include "burnish/base/rigid.h"
#include "burnish/measure/truth.h"
#include "burnish/shapes/shapes.h"
#include "burnish/triangulation/fan_thinning.h"
#include "burnish/triangulation/global.h"
#include "burnish/triangulation/index_heap.h"
#include "support/fan_geometry.h"
#include "support/progress.h"

namespace burnish {
namespace {

using test::differing_fans;

/// A grid of (n + 1)^2 points over the unit square; those inside are moved aside a little, so that
/// no two distances are equal. `height(x, y)` is their z.
template <class Height>
PointCloud square(int n, Height height) {
  Random random(static_cast<std::uint64_t>(n));
  PointCloud cloud;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const double across = 0.4 * (random.uniform() - 0.5) / n;
      const double along = 0.4 * (random.uniform() - 0.5) / n;
      const double x = i / double(n) + (i % n != 0 ? across : 0);
      const double y = j / double(n) + (j % n != 0 ? along : 0);
      cloud.positions.push_back(Vec3f(Vec3d{x, y, height(x, y)}));
    }
  }
  return cloud;
}

double flat(double, double) {
  return 0;
}

double wavy(double x, double y) {
  return 0.1 * std::sin(5 * x) * std::cos(7 * y);
}

PointCloud on_sphere(std::size_t count) {
  Random random(count);
  PointCloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.normal(), y = random.normal(), z = random.normal();
    cloud.positions.push_back(Vec3f(normalized(Vec3d{x, y, z})));
  }
  return cloud;
}

AdaptiveFanCloud adaptive(const PointCloud& cloud, const AdaptiveFanCloudParams& params = {}) {
  return AdaptiveFanCloud::build(cloud, params).value();
}

std::vector<std::uint32_t> log_of(const AdaptiveFanCloud& cloud) {
  std::vector<std::uint32_t> points;
  for (const auto& removal : cloud.log()) points.push_back(removal.point);
  return points;
}

TEST(AdaptiveFanCloud, ARidgeStaysLongerThanThePlanesBesideIt) {
  const int n = 24;
  const auto tent = [](double x, double) { return -std::abs(x - 0.5); };
  AdaptiveFanCloud cloud = adaptive(square(n, tent));
  const auto on_ridge = [&](std::uint32_t p) {
    return std::abs(cloud.fans().positions()[p].x - 0.5f) < 0.25f / n;
  };
  std::size_t ridge = 0;
  for (std::uint32_t p = 0; p < cloud.size(); ++p) ridge += on_ridge(p);
  EXPECT_GT(ridge, 10u);
  ASSERT_TRUE(cloud.to_points(cloud.size() / 2));
  for (const std::uint32_t p : log_of(cloud)) EXPECT_FALSE(on_ridge(p)) << p;
}

TEST(AdaptiveFanCloud, TheCornersOfAnOutlineStayAndItsStraightEdgesAreThinned) {
  const int n = 24;
  AdaptiveFanCloud cloud = adaptive(square(n, flat));
  ASSERT_TRUE(cloud.to_points(cloud.size() / 20));
  std::size_t on_edges = 0;
  for (const Vec3f& p : cloud.active_cloud().positions) {
    on_edges += p.x == 0 || p.x == 1 || p.y == 0 || p.y == 1;
  }
  for (const std::uint32_t corner : {0, n, n * (n + 1), (n + 1) * (n + 1) - 1}) {
    EXPECT_TRUE(cloud.fans().active(corner)) << corner;
  }
  EXPECT_LT(on_edges, static_cast<std::size_t>(2 * n));
}

TEST(AdaptiveFanCloud, ARoundOutlineIsNotEroded) {
  PointCloud disc;
  Random random(3);
  while (disc.positions.size() < 1200) {
    const double x = 2 * random.uniform() - 1, y = 2 * random.uniform() - 1;
    if (x * x + y * y < 0.98) disc.positions.push_back(Vec3f(Vec3d{x, y, 0}));
  }
  for (int i = 0; i < 120; ++i) {
    const double angle = 2 * std::numbers::pi * i / 120;
    disc.positions.push_back(Vec3f(Vec3d{std::cos(angle), std::sin(angle), 0}));
  }
  AdaptiveFanCloud cloud = adaptive(disc);
  ASSERT_TRUE(cloud.to_points(120));
  // Every direction still has a point nearly as far out: what chords of half a radian cut off.
  for (int i = 0; i < 60; ++i) {
    const double angle = 2 * std::numbers::pi * i / 60;
    double reach = 0;
    for (const Vec3f& p : cloud.active_cloud().positions) {
      reach = std::max(reach, p.x * std::cos(angle) + p.y * std::sin(angle));
    }
    EXPECT_GT(reach, std::cos(0.25)) << angle;
  }
}

TEST(AdaptiveFanCloud, TheWayDownAndBackUpEndsWhereItBegan) {
  for (const FanVariant variant : {FanVariant::ring, FanVariant::delaunay}) {
    AdaptiveFanCloudParams params;
    params.fans.variant = variant;
    const AdaptiveFanCloud original = adaptive(on_sphere(600), params);
    AdaptiveFanCloud halfway = original, cloud = original;
    ASSERT_TRUE(halfway.to_points(250));
    ASSERT_TRUE(cloud.to_points(30));
    EXPECT_EQ(differing_fans(cloud.fans()), 0u);
    ASSERT_TRUE(cloud.to_points(250));
    EXPECT_EQ(differing_fans(cloud.fans(), halfway.fans()), 0u);
    EXPECT_EQ(log_of(cloud), log_of(halfway));
    ASSERT_TRUE(cloud.restore());
    EXPECT_EQ(differing_fans(cloud.fans(), original.fans()), 0u);
    EXPECT_TRUE(cloud.log().empty());
    EXPECT_EQ(cloud.active_cloud(), original.active_cloud());
  }
}

TEST(AdaptiveFanCloud, TwoStepsDownAreTheSameAsOne) {
  AdaptiveFanCloud one_step = adaptive(square(20, wavy)), two_steps = one_step;
  ASSERT_TRUE(one_step.to_points(100));
  ASSERT_TRUE(two_steps.to_points(300));
  ASSERT_TRUE(two_steps.to_points(100));
  EXPECT_EQ(log_of(one_step), log_of(two_steps));
}

TEST(AdaptiveFanCloud, PointsThatComeBackOneByOneAreThoseThatComeBackAtOnce) {
  AdaptiveFanCloud cloud = adaptive(on_sphere(600));
  ASSERT_TRUE(cloud.to_points(500));
  AdaptiveFanCloud at_once = cloud;
  for (std::size_t count = 501; count <= 600; ++count) ASSERT_TRUE(cloud.to_points(count));
  ASSERT_TRUE(at_once.restore());
  EXPECT_EQ(differing_fans(cloud.fans(), at_once.fans()), 0u);
}

TEST(AdaptiveFanCloud, AfterAnyChainOfUpdatesItIsWhatItsActivePointsGive) {
  Random random(5);
  AdaptiveFanCloud cloud = adaptive(square(20, wavy));
  const AdaptiveFanCloud original = cloud;
  for (int update = 0; update < 40; ++update) {
    const auto column = static_cast<float>(random.uniform());
    const auto width = static_cast<float>(random.uniform());
    const auto selected = [&](std::uint32_t p) {
      return std::abs(cloud.fans().positions()[p].x - column) < 0.5f * width;
    };
    const std::size_t count = random.below(cloud.size());
    switch (random.below(4)) {
      case 0:
        ASSERT_TRUE(cloud.reduce(selected, count / 4));
        break;
      case 1:
        ASSERT_TRUE(cloud.refine(selected));
        break;
      case 2:
        ASSERT_TRUE(cloud.refine(selected, count / 2));
        break;
      default:
        ASSERT_TRUE(cloud.to_points(count));
        ASSERT_EQ(cloud.active_count(), count);
    }
    ASSERT_EQ(differing_fans(cloud.fans()), 0u) << "after update " << update;
    for (const std::uint32_t p : log_of(cloud)) ASSERT_FALSE(cloud.fans().active(p));
  }
  ASSERT_TRUE(cloud.restore());
  EXPECT_EQ(differing_fans(cloud.fans(), original.fans()), 0u);
}

TEST(AdaptiveFanCloud, OnlyTheSelectionChanges) {
  AdaptiveFanCloud cloud = adaptive(square(16, wavy));
  const auto left = [&](std::uint32_t p) { return cloud.fans().positions()[p].x < 0.5f; };
  ASSERT_TRUE(cloud.reduce(left, 30));
  std::size_t left_active = 0;
  for (std::uint32_t p = 0; p < cloud.size(); ++p) {
    if (left(p)) {
      left_active += cloud.fans().active(p);
    } else {
      EXPECT_TRUE(cloud.fans().active(p));
    }
  }
  EXPECT_EQ(left_active, 30u);
  ASSERT_TRUE(cloud.to_points(100));
  ASSERT_TRUE(cloud.refine(left));
  for (std::uint32_t p = 0; p < cloud.size(); ++p) {
    EXPECT_TRUE(!left(p) || cloud.fans().active(p));
  }
  EXPECT_LT(cloud.active_count(), cloud.size());
}

TEST(AdaptiveFanCloud, TheOrderIsTheSameForEveryNumberOfThreadsAndOfEqualPointsTheFirstGoes) {
  PointCloud lattice;
  for (int i = 0; i < 15 * 15; ++i) {
    lattice.positions.push_back({static_cast<float>(i % 15), static_cast<float>(i / 15), 0});
  }
  Context context;
  context.threads = 1;
  AdaptiveFanCloud alone = AdaptiveFanCloud::build(lattice, {}, context).value();
  ASSERT_TRUE(alone.to_points(20, context));
  context.threads = 3;
  AdaptiveFanCloud together = AdaptiveFanCloud::build(lattice, {}, context).value();
  ASSERT_TRUE(together.to_points(20, context));
  EXPECT_EQ(log_of(alone), log_of(together));
  // The 3 x 3 around every point inside are alike; the outline has more information.
  EXPECT_EQ(alone.log().front().point, 16u);
}

/// What a rigid motion moves.
std::vector<Vec3f> moved(const std::vector<Vec3f>& positions, const RigidTransform& T) {
  std::vector<Vec3f> result;
  for (const Vec3f& p : positions) result.push_back(Vec3f(T(Vec3d(p))));
  return result;
}

const RigidTransform kMotion = rigid_from_quaternion(0.2, -0.5, 0.3, 0.7, {1, -2, 0.5});

/// The largest distance between points of the same number.
double farthest(std::span<const Vec3f> a, std::span<const Vec3f> b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    most = std::max(most, norm(Vec3d(a[i]) - Vec3d(b[i])));
  }
  return most;
}

TEST(AdaptiveFanCloud, DetailFollowsARigidMotionOfThePointsThatAreThere) {
  PointCloud plain = square(20, wavy);
  for (int copy = 0; copy < 5; ++copy) plain.positions.push_back(plain.positions[40]);
  for (int i = 0; i < 4; ++i) plain.positions.push_back({3.f + i, 0, 0});  // in a line
  AdaptiveFanCloud cloud = adaptive(plain);
  ASSERT_TRUE(cloud.to_points(40));
  const auto there = moved(cloud.active_cloud().positions, kMotion);
  ASSERT_TRUE(cloud.set_positions(there, WayBack::detail));
  EXPECT_EQ(differing_fans(cloud.fans()), 0u);
  ASSERT_TRUE(cloud.restore());
  EXPECT_EQ(differing_fans(cloud.fans()), 0u);
  // The points in a line span no plane: they are moved with the nearest, not turned.
  const std::size_t surface = plain.positions.size() - 4;
  const auto expected = moved(plain.positions, kMotion);
  // A place of about 3 is rounded to 2.4e-7, through some generations of neighbours.
  EXPECT_LT(farthest(cloud.fans().positions().first(surface), std::span(expected).first(surface)),
            2e-5);
}

TEST(AdaptiveFanCloud, NormalsFollowTheDetail) {
  PointCloud ball = on_sphere(500);
  ball.attributes.normals = ball.positions;
  AdaptiveFanCloud cloud = adaptive(ball);
  ASSERT_TRUE(cloud.to_points(60));
  const RigidTransform turn = rigid_from_quaternion(0.2, -0.5, 0.3, 0.7, {});
  const auto there = moved(cloud.active_cloud().positions, turn);
  ASSERT_TRUE(cloud.set_positions(there, WayBack::detail, there));
  ASSERT_TRUE(cloud.restore());
  const auto expected = moved(ball.positions, turn);
  EXPECT_LT(farthest(cloud.fans().positions(), expected), 2e-5);
  EXPECT_LT(farthest(cloud.fans().normals(), expected), 2e-5);
}

TEST(AdaptiveFanCloud, TheExactWayBackLeavesWhatIsAwayBitForBit) {
  const PointCloud plain = square(12, wavy);
  AdaptiveFanCloud cloud = adaptive(plain);
  ASSERT_TRUE(cloud.to_points(30));
  const std::vector<std::uint32_t> away = log_of(cloud);
  const auto there = moved(cloud.active_cloud().positions, kMotion);
  ASSERT_TRUE(cloud.set_positions(there, WayBack::exact));
  EXPECT_EQ(cloud.active_cloud().positions, there);
  ASSERT_TRUE(cloud.restore());
  for (const std::uint32_t p : away) EXPECT_EQ(cloud.fans().positions()[p], plain.positions[p]);
}

TEST(AdaptiveFanCloud, RefusesPositionsThatDoNotFit) {
  AdaptiveFanCloud cloud = adaptive(on_sphere(50));
  ASSERT_TRUE(cloud.to_points(20));
  const AdaptiveFanCloud before = cloud;
  std::vector<Vec3f> positions(19);
  EXPECT_EQ(cloud.set_positions(positions, WayBack::exact).error().code,
            ErrorCode::invalid_argument);
  positions.resize(20, {std::numeric_limits<float>::quiet_NaN(), 0, 0});
  EXPECT_EQ(cloud.set_positions(positions, WayBack::detail).error().code, ErrorCode::bad_geometry);
  positions = before.active_cloud().positions;
  EXPECT_EQ(cloud.set_positions(positions, WayBack::exact, positions).error().code,
            ErrorCode::invalid_argument);
  EXPECT_EQ(cloud.active_cloud(), before.active_cloud());
  EXPECT_EQ(differing_fans(cloud.fans(), before.fans()), 0u);
}

TEST(AdaptiveFanCloud, TakesWhatIsNoSurface) {
  PointCloud line, lattice, one_place;
  for (int i = 0; i < 40; ++i) line.positions.push_back({static_cast<float>(i), 0, 0});
  for (int i = 0; i < 64; ++i) {
    lattice.positions.push_back(
        {static_cast<float>(i % 4), static_cast<float>(i / 4 % 4), static_cast<float>(i / 16)});
  }
  one_place.positions.resize(20, {1, 2, 3});
  std::vector<PointCloud> clouds{{}, on_sphere(1), on_sphere(2), on_sphere(3)};
  clouds.insert(clouds.end(), {line, lattice, one_place});
  for (const PointCloud& plain : clouds) {
    AdaptiveFanCloud cloud = adaptive(plain);
    for (const std::size_t share : {2, 5, 100}) {
      ASSERT_TRUE(cloud.to_points(plain.positions.size() / share));
      EXPECT_EQ(cloud.active_count(), plain.positions.size() / share);
      EXPECT_EQ(differing_fans(cloud.fans()), 0u);
    }
    ASSERT_TRUE(cloud.restore());
    EXPECT_EQ(cloud.active_cloud(), plain);
  }
}

TEST(AdaptiveFanCloud, OfSeveralPointsInOnePlaceAllButOneGoFirst) {
  PointCloud plain = square(10, wavy);
  const std::size_t distinct = plain.positions.size();
  for (std::size_t i = 0; i < distinct; i += 3) plain.positions.push_back(plain.positions[i]);
  AdaptiveFanCloud cloud = adaptive(plain);
  ASSERT_TRUE(cloud.to_points(distinct));
  const auto left = cloud.active_cloud().positions;
  std::set<std::array<float, 3>> places;
  for (const Vec3f& p : left) places.insert({p.x, p.y, p.z});
  EXPECT_EQ(places.size(), distinct);
}

TEST(AdaptiveFanCloud, AttributesGoWithTheirPoints) {
  PointCloud plain = square(8, wavy);
  const std::size_t count = plain.positions.size();
  std::vector<std::int32_t> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    numbers.push_back(static_cast<std::int32_t>(i));
    plain.attributes.normals.push_back({0, 0, 1});
    plain.attributes.sigma.push_back(static_cast<float>(i));
    plain.attributes.colors.push_back({static_cast<std::uint8_t>(i), 0, 0, 255});
    plain.attributes.observations.push_back(static_cast<std::uint32_t>(i));
  }
  plain.attributes.channels.push_back({"number", numbers});
  plain.viewpoint = Vec3d{0, 0, 5};
  AdaptiveFanCloud cloud = adaptive(plain);
  ASSERT_TRUE(cloud.to_points(30));
  std::vector<std::uint32_t> kept;
  for (std::uint32_t p = 0; p < count; ++p) {
    if (cloud.fans().active(p)) kept.push_back(p);
  }
  PointCloud expected = select(plain, kept);
  EXPECT_EQ(cloud.active_cloud(), expected);
}

TEST(AdaptiveFanCloud, AColorEdgeOnAPlaneStays) {
  const int n = 20;
  PointCloud plain = square(n, flat);
  for (const Vec3f& p : plain.positions) {
    const std::uint8_t grey = p.x < 0.5f ? 0 : 255;
    plain.attributes.colors.push_back({grey, grey, grey, 255});
  }
  AdaptiveFanCloud cloud = adaptive(plain);
  ASSERT_TRUE(cloud.to_points(cloud.size() / 4));
  std::size_t near = 0;
  for (const Vec3f& p : cloud.active_cloud().positions) near += std::abs(p.x - 0.5f) < 1.f / n;
  // The strip is a tenth of the square.
  EXPECT_GT(near, cloud.active_count() / 5);
}

TEST(AdaptiveFanCloud, WhatTheSensorMayHaveMadeUpIsNoInformation) {
  Random random(4);
  const double sigma = 0.01;
  PointCloud plain = square(24, [&](double, double) { return sigma * random.normal(); });
  PointCloud known = plain;
  known.attributes.sigma.assign(known.positions.size(), static_cast<float>(sigma));
  const auto rms = [](const PointCloud& cloud) {
    AdaptiveFanCloud fans = adaptive(cloud);
    EXPECT_TRUE(fans.to_points(fans.size() / 4));
    double sum = 0;
    for (const Vec3f& p : fans.active_cloud().positions) sum += double(p.z) * p.z;
    return std::sqrt(sum / static_cast<double>(fans.active_count()));
  };
  EXPECT_GT(rms(plain), 1.2 * sigma);  // the farthest from the plane stayed
  EXPECT_LT(rms(known), 0.5 * (rms(plain) + sigma));
}

TEST(AdaptiveFanCloud, LeavesMissingPixelsOutAndRefusesOtherPlacesThatAreNone) {
  PointCloud plain = on_sphere(30);
  plain.positions[7].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(AdaptiveFanCloud::build(plain).error().code, ErrorCode::bad_geometry);
  plain.positions[7] = Vec3f{1, 1, 1} * std::numeric_limits<float>::quiet_NaN();
  plain.grid = GridSize{6, 5};
  EXPECT_EQ(adaptive(plain).size(), 29u);
  AdaptiveFanCloudParams params;
  params.weights.normal_weight = -1;
  EXPECT_EQ(AdaptiveFanCloud::build(on_sphere(9), params).error().code,
            ErrorCode::invalid_argument);
}

TEST(AdaptiveFanCloud, ACancelledUpdateStopsAtALevelBetween) {
  AdaptiveFanCloud cloud = adaptive(on_sphere(1000));
  test::CancelAt cancel(0.5);
  const auto done = cloud.to_points(100, cancel.context());
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::cancelled);
  EXPECT_GT(cloud.active_count(), 100u);
  EXPECT_LT(cloud.active_count(), 1000u);
  EXPECT_EQ(differing_fans(cloud.fans()), 0u);
}

/// How far the surface through some points of a mesh is from it, both ways, root mean square.
double loss(const PointCloud& points, const TriangleMesh& mesh) {
  const Triangulation surface = triangulate_global(points).value();
  const TruthComparison c = compare_to_truth(surface.mesh, mesh, {.samples = 10000}).value();
  return std::max(c.to_truth.rms, c.from_truth.rms);
}

TEST(FanThinning, KeepsTheShapeBetterThanChance) {
  const TriangleMesh torus = make_torus(1, 0.35, 100, 40);
  PointCloud thinned{torus.positions, {}, {}, {}, {}};
  const std::size_t count = torus.positions.size(), kept = count / 10;
  PointCloud chosen = thinned;
  Random random(1);
  for (std::size_t i = 0; i < kept; ++i) {
    std::swap(chosen.positions[i], chosen.positions[i + random.below(count - i)]);
  }
  chosen.positions.resize(kept);
  ASSERT_TRUE(thin_by_fans(thinned, {.target_points = static_cast<int>(kept)}));
  EXPECT_EQ(thinned.positions.size(), kept);
  EXPECT_LT(loss(thinned, torus), 0.6 * loss(chosen, torus));
}

TEST(FanThinning, StopsAtTheLargerTargetAndKeepsTheOrder) {
  const PointCloud plain = on_sphere(200);
  const auto left = [&](const FanThinningParams& params) {
    PointCloud cloud = plain;
    const FanThinningReport report = thin_by_fans(cloud, params).value();
    EXPECT_EQ(report.points_before, 200u);
    EXPECT_EQ(report.points, cloud.positions.size());
    std::size_t place = 0;
    for (const Vec3f& p : cloud.positions) {
      while (place < 200 && plain.positions[place] != p) ++place;
    }
    EXPECT_LT(place, 200u) << "not in the order in which they were";
    return cloud.positions.size();
  };
  EXPECT_EQ(left({}), 100u);
  EXPECT_EQ(left({.ratio = 0.1}), 20u);
  EXPECT_EQ(left({.target_points = 30, .ratio = 0.1}), 30u);
  EXPECT_EQ(left({.target_points = 1000}), 200u);
  EXPECT_EQ(left({.ratio = 1e-9}), 1u);
}

TEST(IndexHeap, GivesTheLeastValueAndOfEqualOnesTheSmallestIndex) {
  Random random(2);
  std::vector<IndexHeap::Item> items;
  std::vector<double> values;
  for (std::uint32_t i = 0; i < 200; ++i) {
    values.push_back(static_cast<double>(random.below(20)));
    items.push_back({values.back(), i});
  }
  std::reverse(items.begin(), items.end());
  IndexHeap heap(items, items.size());
  std::set<std::pair<double, std::uint32_t>> expected;
  for (std::uint32_t i = 0; i < 200; ++i) expected.insert({values[i], i});
  while (!expected.empty()) {
    for (int change = 0; change < 3; ++change) {
      const auto i = static_cast<std::uint32_t>(random.below(values.size()));
      if (!heap.contains(i)) continue;
      expected.erase({values[i], i});
      values[i] = static_cast<double>(random.below(20));
      expected.insert({values[i], i});
      heap.change(i, values[i]);
    }
    const IndexHeap::Item least = heap.pop();
    ASSERT_EQ(std::pair(least.value, least.index), *expected.begin());
    expected.erase(expected.begin());
    ASSERT_FALSE(heap.contains(least.index));
  }
  EXPECT_EQ(heap.size(), 0u);
}

}  // namespace
}  // namespace burnish
