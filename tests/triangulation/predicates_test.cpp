#include "burnish/triangulation/predicates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "burnish/base/random.h"
#include "burnish/triangulation/expansion.h"

namespace burnish {
namespace {

__extension__ using Wide = __int128;

using Four = std::array<Vec2d, 4>;

/// Twice the area of a triangle of whole numbers below 2^60.
Wide area(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  const auto whole = [](double x) { return static_cast<Wide>(x); };
  return (whole(a.x) - whole(c.x)) * (whole(b.y) - whole(c.y)) -
         (whole(a.y) - whole(c.y)) * (whole(b.x) - whole(c.x));
}

/// The in-circle determinant of whole numbers below 2^28.
Wide circle(const Four& p) {
  std::array<Wide, 3> x, y, lift;
  for (std::size_t i = 0; i < 3; ++i) {
    x[i] = static_cast<Wide>(p[i].x) - static_cast<Wide>(p[3].x);
    y[i] = static_cast<Wide>(p[i].y) - static_cast<Wide>(p[3].y);
    lift[i] = x[i] * x[i] + y[i] * y[i];
  }
  return lift[0] * (x[1] * y[2] - x[2] * y[1]) + lift[1] * (x[2] * y[0] - x[0] * y[2]) +
         lift[2] * (x[0] * y[1] - x[1] * y[0]);
}

/// Corners of a rectangle, which are on one circle, each moved by at most one unit.
Four nearly_cocircular(Random& random, double size) {
  const double x = std::floor(random.uniform(0, size)), y = std::floor(random.uniform(0, size));
  const double w = 1 + std::floor(random.uniform(0, size));
  const double h = 1 + std::floor(random.uniform(0, size));
  Four p{{{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}}};
  for (Vec2d& q : p) {
    if (random.below(2) == 0) q.x += static_cast<double>(random.below(3)) - 1;
    if (random.below(2) == 0) q.y += static_cast<double>(random.below(3)) - 1;
  }
  return p;
}

double lowest_bit(double x) {
  int exponent = 0;
  const auto digits = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
  return std::ldexp(static_cast<double>(digits & -digits), exponent - 53);
}

TEST(Expansion, KeepsEveryBit) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const double a = std::ldexp(random.normal(), static_cast<int>(random.below(80)) - 40);
    const double b = std::ldexp(random.normal(), static_cast<int>(random.below(80)) - 40);
    const auto sum = difference(a, -b), apart = difference(a, b);
    const auto squares = difference(a, 0) * a - difference(b, 0) * b;
    EXPECT_EQ((sum * apart - squares).sign(), 0);  // (a + b) (a - b) = a^2 - b^2
    EXPECT_EQ((sum + apart - difference(a, 0) * 2).sign(), 0);
    const auto a_bit_more = difference(std::nextafter(a, HUGE_VAL), b);
    EXPECT_EQ((sum * a_bit_more - sum * apart).sign(), sum.sign());
    for (std::size_t k = 1; k < squares.size(); ++k) {
      EXPECT_LT(std::abs(squares[k - 1]), lowest_bit(squares[k]));  // terms do not overlap
    }
  }
}

TEST(CounterClockwise, IsExactOnPointsThatRoundingPutsOnALine) {
  // Around (1/2, 1/2), in steps of the last bit, against the line through (12, 12) and (24, 24)
  // (Kettner et al. 2008, figure 2), where the rounded formula is wrong nearly everywhere.
  const double unit = 0x1p-53;
  int collinear = 0;
  for (int i = 0; i < 64; ++i) {
    for (int j = 0; j < 64; ++j) {
      const Vec2d p{0.5 + i * unit, 0.5 + j * unit}, q{12, 12}, r{24, 24};
      EXPECT_EQ(counter_clockwise(p, q, r), j > i) << i << ' ' << j;
      EXPECT_EQ(counter_clockwise(q, p, r), j < i) << i << ' ' << j;
      EXPECT_EQ(counter_clockwise(r, p, q), j > i) << i << ' ' << j;
      collinear += i == j;
    }
  }
  EXPECT_EQ(collinear, 64);
}

TEST(CounterClockwise, AgreesWithWholeNumbers) {
  Random random(2);
  int on_a_line = 0;
  for (int i = 0; i < 20000; ++i) {
    // a, b far apart, c within a unit of the line through them.
    const double size = i % 2 == 0 ? 100 : 0x1p52;
    const Vec2d a{std::floor(random.uniform(0, size)), std::floor(random.uniform(0, size))};
    const Vec2d step{std::floor(random.uniform(0, size)), std::floor(random.uniform(0, size))};
    const Vec2d b{a.x + 2 * step.x, a.y + 2 * step.y};
    const Vec2d c{a.x + step.x + static_cast<double>(random.below(2)), a.y + step.y};
    const Wide expected = area(a, b, c);
    on_a_line += expected == 0;
    EXPECT_EQ(counter_clockwise(a, b, c), expected > 0);
    EXPECT_EQ(counter_clockwise(b, a, c), expected < 0);
  }
  EXPECT_GT(on_a_line, 5000);
}

TEST(InCircle, AgreesWithWholeNumbers) {
  Random random(3);
  int on_the_circle = 0;
  for (int i = 0; i < 20000; ++i) {
    const Four p = nearly_cocircular(random, i % 2 == 0 ? 10 : 0x1p26);
    if (area(p[0], p[1], p[2]) <= 0) continue;
    const Wide expected = circle(p);
    on_the_circle += expected == 0;
    if (expected != 0) {
      EXPECT_EQ(in_circle(p[0], p[1], p[2], p[3]), expected > 0);
    }
  }
  EXPECT_GT(on_the_circle, 1000);
}

TEST(InCircle, DoesNotDependOnThePowerOfTwoThatCoordinatesAreMultipliedBy) {
  Random random(4);
  for (int i = 0; i < 2000; ++i) {
    const Four p = nearly_cocircular(random, 0x1p24);
    if (area(p[0], p[1], p[2]) <= 0) continue;
    const bool expected = in_circle(p[0], p[1], p[2], p[3]);
    for (const double factor : {0x1p-200, 0x1p-149, 0x1p103, 0x1p175}) {
      Four q = p;
      for (Vec2d& point : q) point = {factor * point.x, factor * point.y};
      EXPECT_EQ(in_circle(q[0], q[1], q[2], q[3]), expected) << factor;
      EXPECT_TRUE(counter_clockwise(q[0], q[1], q[2])) << factor;
    }
  }
}

TEST(InCircle, TakesTheLargestOfFourPointsOnACircleForOutside) {
  // (1, 1) is the largest corner: the diagonal is the one between the others.
  const Four square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  EXPECT_FALSE(in_circle(square[0], square[1], square[3], square[2]));
  EXPECT_FALSE(in_circle(square[1], square[2], square[3], square[0]));
  EXPECT_TRUE(in_circle(square[0], square[1], square[2], square[3]));
  EXPECT_TRUE(in_circle(square[0], square[2], square[3], square[1]));
}

TEST(InCircle, ChoosesOneDiagonalOfFourPointsOnACircle) {
  Random random(5);
  for (int i = 0; i < 1000; ++i) {
    // Of the 12 points of whole coordinates on the circle of radius 5, four in a ring.
    constexpr std::array<std::array<int, 2>, 12> kRing{{{5, 0},
                                                        {4, 3},
                                                        {3, 4},
                                                        {0, 5},
                                                        {-3, 4},
                                                        {-4, 3},
                                                        {-5, 0},
                                                        {-4, -3},
                                                        {-3, -4},
                                                        {0, -5},
                                                        {3, -4},
                                                        {4, -3}}};
    std::array<std::size_t, 4> chosen;
    do {
      for (std::size_t& c : chosen) c = random.below(12);
      std::sort(chosen.begin(), chosen.end());
    } while (std::adjacent_find(chosen.begin(), chosen.end()) != chosen.end());
    Four p;
    const std::size_t start = random.below(4);
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& place = kRing[chosen[(start + k) % 4]];
      p[k] = {static_cast<double>(place[0]), static_cast<double>(place[1])};
    }
    const bool ac = !in_circle(p[0], p[1], p[2], p[3]), bd = !in_circle(p[1], p[2], p[3], p[0]);
    EXPECT_NE(ac, bd);  // exactly one of the two pairs of triangles is Delaunay
    EXPECT_EQ(!in_circle(p[2], p[3], p[0], p[1]), ac);
    EXPECT_EQ(!in_circle(p[3], p[0], p[1], p[2]), bd);
    EXPECT_EQ(in_circle(p[1], p[2], p[0], p[3]), !ac);  // whichever corner comes first
  }
}

}  // namespace
}  // namespace burnish
