#pragma once

#include <cmath>

namespace burnish {

/// A point of a plane.
struct Vec2d {
  double x, y;
  friend bool operator==(const Vec2d&, const Vec2d&) = default;
};

/// By x, then by y.
inline bool lexicographically_less(const Vec2d& a, const Vec2d& b) {
  return a.x != b.x ? a.x < b.x : a.y < b.y;
}

// Exact for coordinates that are 0 or between 2^-200 and 2^200 in magnitude, which every float is:
// nothing in between overflows or underflows then. Most answers are certain from the rounded
// determinant and an estimate of its error; the others are computed again without rounding.

namespace predicate_detail {
int exact_orientation(const Vec2d& a, const Vec2d& b, const Vec2d& c);
bool exact_in_circle(const Vec2d& a, const Vec2d& b, const Vec2d& c, const Vec2d& d);

// Rounded determinants are off by at most so much of the same sum of magnitudes (Shewchuk 1997,
// table 2 and figure 21).
constexpr double kHalfUlp = 0x1p-53;
constexpr double kOrientationError = (3 + 16 * kHalfUlp) * kHalfUlp;
constexpr double kInCircleError = (10 + 96 * kHalfUlp) * kHalfUlp;
}  // namespace predicate_detail

/// Whether a, b, c turn to the left: strictly counter-clockwise.
inline bool counter_clockwise(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
  const double determinant = left - right;
  const double error = predicate_detail::kOrientationError * (std::abs(left) + std::abs(right));
  if (determinant > error) return true;
  if (determinant < -error) return false;
  return predicate_detail::exact_orientation(a, b, c) > 0;
}

/// Whether d is inside the circle through a, b and c, which are counter-clockwise. Of four distinct
/// points of one circle the lexicographically largest counts as outside of the circle of the
/// others: as if points were lifted off the paraboloid by infinitely small amounts, the larger ones
/// by far more (Devillers and Teillaud 2003). With it every set of points has one Delaunay
/// triangulation.
inline bool in_circle(const Vec2d& a, const Vec2d& b, const Vec2d& c, const Vec2d& d) {
  const double adx = a.x - d.x, ady = a.y - d.y;
  const double bdx = b.x - d.x, bdy = b.y - d.y;
  const double cdx = c.x - d.x, cdy = c.y - d.y;
  const double a_lift = adx * adx + ady * ady;
  const double b_lift = bdx * bdx + bdy * bdy;
  const double c_lift = cdx * cdx + cdy * cdy;
  const double bc = bdx * cdy, cb = cdx * bdy;
  const double ca = cdx * ady, ac = adx * cdy;
  const double ab = adx * bdy, ba = bdx * ady;
  const double determinant = a_lift * (bc - cb) + b_lift * (ca - ac) + c_lift * (ab - ba);
  const double error = predicate_detail::kInCircleError * (a_lift * (std::abs(bc) + std::abs(cb)) +
                                                           b_lift * (std::abs(ca) + std::abs(ac)) +
                                                           c_lift * (std::abs(ab) + std::abs(ba)));
  if (determinant > error) return true;
  if (determinant < -error) return false;
  return predicate_detail::exact_in_circle(a, b, c, d);
}

}  // namespace burnish
