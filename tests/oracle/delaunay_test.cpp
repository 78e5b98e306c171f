#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "burnish/base/random.h"
#include "burnish/triangulation/planar_delaunay.h"
#include "burnish/triangulation/plane_order.h"
#include "support/plane_mesh.h"

// CGAL chooses among points of one circle by the same rule, so that the triangles must be equal in
// every case, with such points and without.
namespace burnish {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

std::vector<std::array<double, 6>> ours(const std::vector<Vec2d>& points) {
  std::vector<Keyed> order = order_in_plane(points);
  const auto same = [&](const Keyed& a, const Keyed& b) {
    return points[a.index] == points[b.index];
  };
  order.erase(std::unique(order.begin(), order.end(), same), order.end());
  std::vector<Triangle> triangles;
  EXPECT_TRUE(planar_delaunay(points, order, {}, triangles));
  return test::soup(points, triangles);
}

std::vector<std::array<double, 6>> theirs(const std::vector<Vec2d>& points) {
  std::vector<Kernel::Point_2> input;
  for (const Vec2d& p : points) input.emplace_back(p.x, p.y);
  const CGAL::Delaunay_triangulation_2<Kernel> delaunay(input.begin(), input.end());
  std::vector<Vec2d> corners;
  std::vector<Triangle> triangles;
  for (auto face = delaunay.finite_faces_begin(); face != delaunay.finite_faces_end(); ++face) {
    const auto first = static_cast<std::uint32_t>(corners.size());
    triangles.push_back({first, first + 1, first + 2});
    for (int k = 0; k < 3; ++k) {
      const Kernel::Point_2& p = face->vertex(k)->point();
      corners.push_back({p.x(), p.y()});
    }
  }
  return test::soup(corners, triangles);
}

/// Points of a kind: place(random, i).
template <class Place>
void expect_equal(std::size_t count, std::uint64_t seed, Place place) {
  Random random(seed);
  std::vector<Vec2d> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back(place(random, static_cast<double>(i)));
  const auto expected = theirs(points);
  EXPECT_FALSE(expected.empty());
  EXPECT_TRUE(ours(points) == expected);
}

Vec2d uniform(Random& random) {
  const double x = random.uniform(), y = random.uniform();
  return {x, y};
}

TEST(DelaunayOracle, RandomPoints) {
  for (std::uint64_t seed = 0; seed < 300; ++seed)
    expect_equal(3 + seed, seed, [](Random& random, double) { return uniform(random); });
  expect_equal(100000, 1, [](Random& random, double) { return uniform(random); });
}

TEST(DelaunayOracle, ClustersOfEverySize) {
  expect_equal(30000, 2, [](Random& random, double i) {
    const Vec2d p = uniform(random), q = uniform(random);
    const double size = std::ldexp(1, -static_cast<int>(random.below(50)));
    return i < 5 ? q : Vec2d{std::floor(5 * p.x) + size * q.x, std::floor(5 * p.y) + size * q.y};
  });
}

TEST(DelaunayOracle, PointsNearlyOnALine) {
  for (const double width : {1e-3, 1e-9, 1e-15, 1e-30}) {
    expect_equal(5000, 3, [&](Random& random, double) {
      const Vec2d p = uniform(random);
      return Vec2d{p.x, width * p.y};
    });
    expect_equal(5000, 4, [&](Random& random, double) {
      const Vec2d p = uniform(random);
      return Vec2d{p.x, p.x / 3 + width * p.y};
    });
  }
}

TEST(DelaunayOracle, PointsNearlyOnACircle) {
  for (const double width : {0.0, 1e-15, 1e-12, 1e-6}) {
    expect_equal(5000, 5, [&](Random& random, double) {
      const Vec2d p = uniform(random);
      const double angle = 2 * std::numbers::pi * p.x, radius = 1 + width * p.y;
      return Vec2d{radius * std::cos(angle), radius * std::sin(angle)};
    });
  }
}

TEST(DelaunayOracle, LatticesOfWholeAndOfRoundedCoordinates) {
  const auto lattice = [](double spacing) {
    return [spacing](Random& random, double) {
      const Vec2d p = uniform(random);
      return Vec2d{std::floor(150 * p.x) * spacing, std::floor(150 * p.y) * spacing};
    };
  };
  expect_equal(20000, 6, lattice(1));
  expect_equal(20000, 7, lattice(0.1));
  expect_equal(20000, 8, [&](Random& random, double i) {
    const Vec2d p = lattice(0.1)(random, i);
    return Vec2d{double{static_cast<float>(p.x)}, double{static_cast<float>(p.y)}};
  });
  // Turned, so that every square is nearly on a circle.
  expect_equal(20000, 9, [&](Random& random, double i) {
    const Vec2d p = lattice(1)(random, i);
    return Vec2d{0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y};
  });
}

TEST(DelaunayOracle, PointsOnTwoCurves) {
  expect_equal(4000, 10, [](Random&, double i) {
    return i < 2000 ? Vec2d{i, 0} : Vec2d{1000, i - 1500.5};
  });
  expect_equal(3000, 11, [](Random&, double i) { return Vec2d{i, i * i}; });
}

}  // namespace
}  // namespace burnish
