#include "burnish/spatial/point_octree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "burnish/base/random.h"

namespace burnish {
namespace {

constexpr double kEverywhere = std::numeric_limits<double>::infinity();

/// What the octree must be equal to.
struct AllPoints {
  struct Point {
    Vec3f position;
    double squared_reach;
  };
  std::map<std::uint32_t, Point> points;

  std::vector<Neighbour> nearest(const Vec3f& query, std::size_t count) const {
    std::vector<Neighbour> all;
    for (const auto& [index, point] : points) {
      all.push_back({index, squared_norm(Vec3d(point.position) - Vec3d(query))});
    }
    std::stable_sort(all.begin(), all.end(), [](const Neighbour& a, const Neighbour& b) {
      return a.squared_distance < b.squared_distance;
    });
    all.resize(std::min(count, all.size()));
    return all;
  }

  std::vector<std::uint32_t> reaching(const Vec3f& query) const {
    std::vector<std::uint32_t> found;
    for (const auto& [index, point] : points) {
      const double squared = squared_norm(Vec3d(point.position) - Vec3d(query));
      if (squared <= point.squared_reach) found.push_back(index);
    }
    return found;
  }

  bool has(const Vec3f& position) const {
    return std::any_of(points.begin(), points.end(),
                       [&](const auto& entry) { return entry.second.position == position; });
  }
};

void expect_equal(const PointOctree& octree, const AllPoints& expected, const Vec3f& query) {
  std::vector<Neighbour> found;
  octree.nearest(query, 12, found);
  EXPECT_EQ(found, expected.nearest(query, 12));
  std::vector<std::uint32_t> reaching;
  octree.reaching(query, reaching);
  std::sort(reaching.begin(), reaching.end());
  EXPECT_EQ(reaching, expected.reaching(query));
}

/// Inserts and erases at random points that `draw` makes, and compares.
template <class Draw>
void play(std::uint64_t seed, std::size_t steps, double reach, Draw draw) {
  Random random(seed);
  PointOctree octree;
  AllPoints expected;
  std::uint32_t next = 0;
  for (std::size_t step = 0; step < steps; ++step) {
    // Grows to some hundreds, shrinks to nothing, and again.
    const bool grow = (step / 600) % 2 == 0;
    const std::uint64_t chance = random.below(10);
    if (chance < (grow ? 7u : 2u)) {
      const Vec3f p = draw(random);
      if (expected.has(p)) continue;
      const double squared_reach = reach * random.uniform();
      octree.insert(next, p, squared_reach);
      expected.points[next++] = {p, squared_reach};
    } else if (!expected.points.empty()) {
      auto at = expected.points.lower_bound(static_cast<std::uint32_t>(random.below(next)));
      if (at == expected.points.end()) at = expected.points.begin();
      if (chance == 9) {
        at->second.squared_reach = reach * random.uniform();
        octree.set_reach(at->first, at->second.position, at->second.squared_reach);
      } else {
        octree.erase(at->first, at->second.position);
        expected.points.erase(at);
      }
    }
    ASSERT_EQ(octree.size(), expected.points.size());
    if (step % 20 == 0) expect_equal(octree, expected, draw(random));
    if (testing::Test::HasFailure()) FAIL() << "step " << step;
  }
}

float coordinate(Random& random) {
  return static_cast<float>(random.uniform(-1, 1));
}

TEST(PointOctree, FindsWhatALookAtAllPointsFinds) {
  play(1, 5000, 0.05, [](Random& random) {
    const float x = coordinate(random), y = coordinate(random), z = coordinate(random);
    return Vec3f{x, y, z};
  });
}

TEST(PointOctree, GoesByTheIndexWhereDistancesAreEqual) {
  play(2, 5000, 9, [](Random& random) {
    const auto x = static_cast<float>(random.below(7)), y = static_cast<float>(random.below(7)),
               z = static_cast<float>(random.below(7));
    return Vec3f{x, y, z};
  });
}

TEST(PointOctree, FollowsTheDensityOverManyOrdersOfMagnitude) {
  play(3, 5000, 1, [](Random& random) {
    const double scale = std::pow(10, random.uniform(-30, 15));
    const float x = coordinate(random), y = coordinate(random), z = coordinate(random);
    return Vec3f(Vec3d(Vec3f{x, y, z}) * scale);
  });
}

TEST(PointOctree, HoldsPointsFarFromTheOriginAndFromEachOther) {
  play(4, 3000, 0.1, [](Random& random) {
    const float x = coordinate(random), y = coordinate(random);
    const bool other = random.below(100) == 0;
    return Vec3f{10000 + x, y, other ? 1e30f : 3e4f};
  });
}

TEST(PointOctree, GivesAllPointsWhereFewerAreThereThanWanted) {
  PointOctree octree;
  std::vector<Neighbour> found{{1, 1}};
  std::vector<std::uint32_t> reaching{1};
  octree.nearest({0, 0, 0}, 3, found);
  octree.reaching({0, 0, 0}, reaching);
  EXPECT_TRUE(found.empty());
  EXPECT_TRUE(reaching.empty());
  octree.insert(7, {1, 2, 2}, kEverywhere);
  octree.nearest({0, 0, 0}, 3, found);
  EXPECT_EQ(found, (std::vector<Neighbour>{{7, 9}}));
  octree.nearest({0, 0, 0}, 0, found);
  EXPECT_TRUE(found.empty());
  octree.reaching({1e30f, 0, 0}, reaching);
  EXPECT_EQ(reaching, std::vector<std::uint32_t>{7});
}

TEST(PointOctree, CountsThePointAtExactlyItsReach) {
  PointOctree octree;
  octree.insert(3, {1, 2, 2}, 9);
  std::vector<std::uint32_t> reaching;
  octree.reaching({0, 0, 0}, reaching);
  EXPECT_EQ(reaching.size(), 1u);
  octree.set_reach(3, {1, 2, 2}, std::nextafter(9.0, 0.0));
  octree.reaching({0, 0, 0}, reaching);
  EXPECT_TRUE(reaching.empty());
}

}  // namespace
}  // namespace burnish
