#include "burnish/triangulation/planar_delaunay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <set>

#include "burnish/base/random.h"
#include "burnish/triangulation/plane_order.h"
#include "support/plane_mesh.h"
#include "support/progress.h"

namespace burnish {
namespace {

using test::LatticePoint;

std::vector<Triangle> triangulated(std::span<const Vec2d> points, const Context& context = {}) {
  std::vector<Triangle> triangles;
  EXPECT_TRUE(planar_delaunay(points, order_in_plane(points), context, triangles));
  return triangles;
}

std::vector<Vec2d> in_plane(const std::vector<LatticePoint>& points) {
  std::vector<Vec2d> result;
  for (const LatticePoint& p : points)
    result.push_back({static_cast<double>(p.x), static_cast<double>(p.y)});
  return result;
}

void expect_delaunay(const std::vector<LatticePoint>& points) {
  EXPECT_EQ(test::delaunay_defect(points, triangulated(in_plane(points))), "")
      << points.size() << " points";
}

/// Distinct points of a lattice of size x size, in no order.
std::vector<LatticePoint> on_lattice(std::size_t count, std::int64_t width, std::int64_t height,
                                     std::uint64_t seed) {
  Random random(seed);
  std::set<LatticePoint> taken;
  std::vector<LatticePoint> points;
  while (points.size() < count) {
    const auto x = static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(width)));
    const auto y = static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(height)));
    if (taken.insert({x, y}).second) points.push_back({x, y});
  }
  return points;
}

std::vector<Vec2d> random_points(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec2d> points(count);
  for (Vec2d& p : points) {
    p.x = random.uniform();
    p.y = random.uniform();
  }
  return points;
}

template <class T>
void shuffle(std::vector<T>& items, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random.below(i)]);
}

TEST(PlanarDelaunay, IsDelaunayOfEveryFewPointsOfASmallLattice) {
  for (std::uint64_t seed = 0; seed < 3000; ++seed)
    expect_delaunay(on_lattice(3 + seed % 20, 5, 5, seed));
}

TEST(PlanarDelaunay, IsDelaunayOfAllPointsOfALattice) {
  expect_delaunay(on_lattice(45 * 45, 45, 45, 1));
}

TEST(PlanarDelaunay, IsDelaunayOfPointsOnALatticeOfAThousand) {
  expect_delaunay(on_lattice(2000, 1000, 1000, 3));
  expect_delaunay(on_lattice(2000, 1000, 3, 4));
  expect_delaunay(on_lattice(20000, 300, 300, 5));  // more than one part
}

TEST(PlanarDelaunay, IsDelaunayOfClustersFarApart) {
  // Within a cluster all points share a cell of the order.
  std::vector<LatticePoint> points;
  for (const std::int64_t corner : {0, 1 << 27}) {
    for (const LatticePoint& p : on_lattice(60, 9, 9, 6)) points.push_back({corner + p.x, p.y});
  }
  points.push_back({1 << 20, 1 << 27});
  expect_delaunay(points);
  std::vector<Vec2d> tiny;
  for (const LatticePoint& p : points) {
    tiny.push_back({static_cast<double>(p.x) * (p.x < 100 ? 0x1p-40 : 1),
                    static_cast<double>(p.y) * (p.y < 100 ? 0x1p-40 : 1)});
  }
  // Of 121 points three are corners of the hull and some are on its edges.
  EXPECT_GT(triangulated(tiny).size(), 121u);
}

TEST(PlanarDelaunay, IsDelaunayOfPointsNearlyOnALineAndOnACurve) {
  std::vector<LatticePoint> line, parabola, two_lines;
  Random random(7);
  for (std::int64_t i = 0; i < 2000; ++i) {
    line.push_back({50 * i, 30 * i + static_cast<std::int64_t>(random.below(3))});
    parabola.push_back({i, i * i});
    two_lines.push_back(i % 2 == 0 ? LatticePoint{i, 0} : LatticePoint{1000, 2 * i});
  }
  expect_delaunay(line);
  expect_delaunay(parabola);
  expect_delaunay(two_lines);
}

TEST(PlanarDelaunay, GivesNothingForPointsOnALineAndForTooFew) {
  std::vector<LatticePoint> line;
  for (std::int64_t i = 0; i < 10000; ++i) line.push_back({3 * i, -2 * i});
  shuffle(line, 8);
  EXPECT_TRUE(triangulated(in_plane(line)).empty());
  for (const std::size_t count : {0, 1, 2}) {
    line.resize(count);
    EXPECT_TRUE(triangulated(in_plane(line)).empty());
  }
}

TEST(PlanarDelaunay, SortsTrianglesByTheirSmallestIndex) {
  const std::vector<Triangle> triangles = triangulated(random_points(500, 9));
  EXPECT_TRUE(std::is_sorted(triangles.begin(), triangles.end()));
  for (const Triangle& t : triangles) EXPECT_EQ(*std::min_element(t.begin(), t.end()), t[0]);
}

TEST(PlanarDelaunay, DoesNotDependOnTheOrderOfThePoints) {
  for (const bool lattice : {false, true}) {
    std::vector<Vec2d> points =
        lattice ? in_plane(on_lattice(10000, 120, 120, 10)) : random_points(10000, 10);
    const auto expected = test::soup(points, triangulated(points));
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      shuffle(points, seed);
      EXPECT_EQ(test::soup(points, triangulated(points)), expected) << lattice;
    }
  }
}

TEST(PlanarDelaunay, ChoosesAmongPointsOfACircleAlikeWhereverItIsCut) {
  // The same lattice beside other points, which move every cut. Far from these the same triangles.
  const std::vector<Vec2d> lattice = in_plane(on_lattice(30 * 30, 30, 30, 11));
  std::vector<Vec2d> more = lattice;
  more.push_back({-1000.5, -777.25});
  more.push_back({1234.25, 4321.5});
  const auto alone = test::soup(lattice, triangulated(lattice));
  const auto among = test::soup(more, triangulated(more));
  EXPECT_EQ(alone.size(), 2u * 29 * 29);
  EXPECT_TRUE(std::includes(among.begin(), among.end(), alone.begin(), alone.end()));
}

TEST(PlanarDelaunay, IsTheSameForAnyNumberOfThreads) {
  const std::vector<Vec2d> points = random_points(50000, 12);
  Context context;
  context.threads = 1;
  const std::vector<Triangle> one = triangulated(points, context);
  for (const int threads : {2, 3, 8}) {
    context.threads = threads;
    EXPECT_EQ(triangulated(points, context), one);
  }
}

TEST(PlanarDelaunay, StopsWhereverItIsCancelled) {
  const std::vector<Vec2d> points = random_points(50000, 13);
  const std::vector<Keyed> order = order_in_plane(points);
  for (const double fraction : {0.0, 0.3, 0.6}) {
    test::CancelAt cancel(fraction);
    std::vector<Triangle> triangles;
    EXPECT_FALSE(planar_delaunay(points, order, cancel.context(), triangles));
  }
}

}  // namespace
}  // namespace burnish
