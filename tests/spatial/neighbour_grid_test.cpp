#include "burnish/spatial/neighbour_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nanoflann.hpp>
#include <numbers>

#include "burnish/base/random.h"

namespace burnish {
namespace {

Vec3f random_point(Random& random, double size) {
  const double x = random.uniform(-size, size);
  const double y = random.uniform(-size, size);
  const double z = random.uniform(-size, size);
  return Vec3f(Vec3d{x, y, z});
}

std::vector<Vec3f> sphere(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3f> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = random.uniform(-1, 1);
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    const double r = std::sqrt(1 - z * z);
    points.push_back(Vec3f(Vec3d{r * std::cos(angle), r * std::sin(angle), z}));
  }
  return points;
}

/// Points of a square whose spacing grows a hundredfold from one side to the other.
std::vector<Vec3f> graded_square(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3f> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = std::pow(100.0, random.uniform() - 1);
    const double y = random.uniform();
    points.push_back(Vec3f(Vec3d{x, y * x, 0.1 * x}));
  }
  return points;
}

/// Small clusters, each of many coincident and nearly coincident points, and a far outlier.
std::vector<Vec3f> clusters(std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3f> points;
  for (int cluster = 0; cluster < 20; ++cluster) {
    const Vec3f centre = random_point(random, 1);
    for (int i = 0; i < 100; ++i) points.push_back(centre);
    for (int i = 0; i < 100; ++i) points.push_back(centre + random_point(random, 1e-5));
  }
  points.push_back({1e6f, -1e6f, 3});
  return points;
}

std::vector<Vec3f> lattice(int side) {
  std::vector<Vec3f> points;
  for (int z = 0; z < side; ++z) {
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) points.push_back(Vec3f(Vec3<int>{x, y, z}));
    }
  }
  return points;
}

double squared_distance(const Vec3f& a, const Vec3f& b) {
  return squared_norm(Vec3d(a) - Vec3d(b));
}

std::vector<Neighbour> by_brute_force(const std::vector<Vec3f>& points, const Vec3f& query) {
  std::vector<Neighbour> all;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    all.push_back({i, squared_distance(points[i], query)});
  }
  std::sort(all.begin(), all.end(), [](const Neighbour& a, const Neighbour& b) {
    return a.squared_distance != b.squared_distance ? a.squared_distance < b.squared_distance
                                                    : a.index < b.index;
  });
  return all;
}

void expect_same_as_brute_force(const std::vector<Vec3f>& points, std::uint64_t seed) {
  const NeighbourGrid grid(points);
  Random random(seed);
  std::vector<Neighbour> found;
  for (int trial = 0; trial < 60; ++trial) {
    const Vec3f query = trial % 4 == 0 ? random_point(random, trial % 8 == 0 ? 2 : 1e4)
                                       : points[random.below(points.size())];
    const auto expected = by_brute_force(points, query);
    for (const std::size_t count :
         {std::size_t{1}, std::size_t{8}, std::size_t{150}, points.size() + 3}) {
      grid.nearest(query, count, found);
      ASSERT_EQ(found.size(), std::min(count, points.size()));
      ASSERT_TRUE(std::equal(found.begin(), found.end(), expected.begin()));
    }
    const double radius =
        std::sqrt(expected[std::min<std::size_t>(30, expected.size() - 1)].squared_distance);
    grid.within(query, radius, found);
    const auto end = std::find_if(expected.begin(), expected.end(), [&](const Neighbour& n) {
      return n.squared_distance > radius * radius;
    });
    ASSERT_EQ(found, std::vector<Neighbour>(expected.begin(), end));
  }
}

TEST(NeighbourGrid, FindsWhatBruteForceFindsInTheSameOrder) {
  expect_same_as_brute_force(sphere(3000, 1), 2);
  expect_same_as_brute_force(sphere(7, 1), 2);
  expect_same_as_brute_force(graded_square(5000, 3), 4);
  expect_same_as_brute_force(clusters(5), 6);
  expect_same_as_brute_force(lattice(10), 7);
  expect_same_as_brute_force({{1, 2, 3}}, 8);
  expect_same_as_brute_force({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, 9);
}

struct Cloud {
  const std::vector<Vec3f>& points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][axis]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};
using Tree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 3>;

TEST(NeighbourGrid, FindsTheDistancesThatNanoflannFinds) {
  for (const auto& points : {sphere(40000, 11), graded_square(40000, 12)}) {
    const Cloud cloud{points};
    const Tree tree(3, cloud);
    const NeighbourGrid grid(points);
    std::vector<Neighbour> found;
    for (std::size_t i = 0; i < points.size(); i += 7) {
      const double query[3] = {points[i].x, points[i].y, points[i].z};
      std::array<std::uint32_t, 16> index;
      std::array<double, 16> squared;
      tree.knnSearch(query, 16, index.data(), squared.data());
      grid.nearest(points[i], 16, found);
      for (std::size_t k = 0; k < 16; ++k) ASSERT_EQ(found[k].squared_distance, squared[k]);
    }
  }
}

TEST(NeighbourGrid, FindsTheSameForAllTogetherAsOneByOne) {
  for (const std::vector<Vec3f>& points :
       {sphere(3000, 1), graded_square(3000, 2), clusters(3), lattice(9), std::vector<Vec3f>{},
        std::vector<Vec3f>(500, Vec3f{1, 2, 3}), std::vector<Vec3f>{{1, 2, 3}, {4, 5, 6}}}) {
    const NeighbourGrid grid(points);
    for (const std::size_t count : {1u, 8u, 17u, 150u}) {
      NeighbourLists lists;
      ASSERT_TRUE(grid.nearest_of_all(count, {}, lists));
      EXPECT_EQ(lists.count(), std::min(count, points.size()));
      std::vector<Neighbour> found;
      for (std::size_t i = 0; i < points.size(); ++i) {
        grid.nearest(points[i], count, found);
        ASSERT_EQ(found.size(), lists.count());
        for (std::size_t k = 0; k < found.size(); ++k) {
          ASSERT_EQ(lists.of(i)[k], found[k].index) << "point " << i << " neighbour " << k;
        }
      }
    }
  }
}

TEST(NeighbourGrid, StaysLinearWhereAllPointsCoincide) {
  const std::vector<Vec3f> points(200000, Vec3f{1, 2, 3});
  const NeighbourGrid grid(points);
  std::vector<Neighbour> found;
  for (const Vec3f& point : points) grid.nearest(point, 10, found);  // 4e10 steps were it quadratic
  ASSERT_EQ(found.size(), 10u);
  for (std::uint32_t i = 0; i < 10; ++i) EXPECT_EQ(found[i], (Neighbour{i, 0.0}));
}

TEST(NeighbourGrid, SkipsWhatIsNotFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const NeighbourGrid grid(std::vector<Vec3f>{{nan, nan, nan}, {0, 0, 0}, {inf, 0, 0}, {1, 0, 0}});
  EXPECT_EQ(grid.size(), 2u);
  std::vector<Neighbour> found{{7, 7}};
  grid.nearest({nan, 0, 0}, 3, found);
  EXPECT_TRUE(found.empty());
  grid.nearest({0, 0, 0}, 3, found);
  EXPECT_EQ(found, (std::vector<Neighbour>{{1, 0.0}, {3, 1.0}}));
  NeighbourGrid(std::vector<Vec3f>{}).nearest({0, 0, 0}, 3, found);
  EXPECT_TRUE(found.empty());
}

TEST(NeighbourGrid, TakesTheSmallestAndTheLargestCoordinates) {
  const float tiny = std::numeric_limits<float>::denorm_min();
  const float huge = std::numeric_limits<float>::max();
  std::vector<Vec3f> points;
  for (int i = 0; i < 100; ++i) points.push_back({tiny * static_cast<float>(i), 0, 0});
  for (int i = -50; i < 50; ++i) points.push_back({0, huge / 51 * static_cast<float>(i), 0});
  expect_same_as_brute_force(points, 13);
}

}  // namespace
}  // namespace burnish
