#pragma once

#include <cstddef>

// Eq. 1 of Ozbay and Cinar over any way of naming points and neighbours, so that each peer reads,
// stores and walks its own mesh and does the same arithmetic. P is a point with +=, - and *.

/// (sum of the neighbours + the nearest + the farthest) / (n + 2); the vertex itself where it has
/// no neighbour. `position(neighbour)` gives a P, `squared(P)` its squared length.
template <class P, class Neighbours, class Position, class Squared>
P equation1(const P& p, const Neighbours& neighbours, Position position, Squared squared) {
  P sum = p - p, nearest = p, farthest = p;
  double least = 0, most = 0;
  std::size_t count = 0;
  for (const auto& neighbour : neighbours) {
    const P q = position(neighbour);
    const double distance = squared(P(q - p));
    if (count == 0 || distance < least) least = distance, nearest = q;
    if (count == 0 || distance > most) most = distance, farthest = q;
    sum += q;
    ++count;
  }
  if (count == 0) return p;
  sum += nearest;
  sum += farthest;
  return sum * (1.0 / static_cast<double>(count + 2));
}
