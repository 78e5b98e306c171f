#include "burnish/triangulation/predicates.h"

#include <algorithm>

#include "burnish/triangulation/expansion.h"

namespace burnish::predicate_detail {

int exact_orientation(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  const auto left = difference(a.x, c.x) * difference(b.y, c.y);
  const auto right = difference(a.y, c.y) * difference(b.x, c.x);
  return (left - right).sign();
}

namespace {

/// Positive where d is inside the circle through a, b and c, negative outside.
int exact_side_of_circle(const Vec2d& a, const Vec2d& b, const Vec2d& c, const Vec2d& d) {
  const auto adx = difference(a.x, d.x), ady = difference(a.y, d.y);
  const auto bdx = difference(b.x, d.x), bdy = difference(b.y, d.y);
  const auto cdx = difference(c.x, d.x), cdy = difference(c.y, d.y);
  const auto a_term = (bdx * cdy - cdx * bdy) * (adx * adx + ady * ady);
  const auto b_term = (cdx * ady - adx * cdy) * (bdx * bdx + bdy * bdy);
  const auto c_term = (adx * bdy - bdx * ady) * (cdx * cdx + cdy * cdy);
  return (a_term + b_term + c_term).sign();
}

}  // namespace

bool exact_in_circle(const Vec2d& a, const Vec2d& b, const Vec2d& c, const Vec2d& d) {
  if (const int side = exact_side_of_circle(a, b, c, d); side != 0) return side > 0;
  // Where a corner of the triangle is lifted most, d is outside if it is opposite to that corner.
  const Vec2d& largest = std::max({a, b, c, d}, lexicographically_less);
  if (largest == d) return false;
  if (largest == a) return exact_orientation(b, c, d) > 0;
  if (largest == b) return exact_orientation(c, a, d) > 0;
  return exact_orientation(a, b, d) > 0;
}

}  // namespace burnish::predicate_detail
