#pragma once

#include <cmath>

namespace burnish {

/// The direction (x, y) as a number that rises with its angle from 0, at the x axis, to 4: so many
/// quarter turns, exact where they are whole, and half a turn farther is 2 more. One division
/// instead of an arc tangent, and the same bits on every machine.
inline double turn_of(double x, double y) {
  const double size = std::abs(x) + std::abs(y);
  if (y >= 0) return x >= 0 ? (size > 0 ? y / size : 0) : 1 - x / size;
  return x < 0 ? 2 - y / size : 3 + x / size;
}

constexpr double kHalfTurn = 2, kFullTurn = 4;

/// From one direction counter-clockwise to another, 0 to 4.
inline double turn_between(double from, double to) {
  return to < from ? to - from + kFullTurn : to - from;
}

}  // namespace burnish
