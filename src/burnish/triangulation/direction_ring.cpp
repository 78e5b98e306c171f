#include "burnish/triangulation/direction_ring.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "burnish/triangulation/turn.h"

namespace burnish {
namespace {

/// Angles that differ by less, rad, are the same: positions are rounded to float.
constexpr double kSame = 1e-6;

}  // namespace

DirectionRing::DirectionRing(double widest) {
  const double most = std::min(widest, std::numbers::pi - 2 * kSame) + kSame;
  cos_ = std::cos(most);
  sin_ = std::sin(most);
}

/// Of a ring that is not empty.
std::size_t DirectionRing::last_before(double turn) const {
  std::size_t i = 0;
  while (i < directions_.size() && directions_[i].turn <= turn) ++i;
  return (i > 0 ? i : directions_.size()) - 1;
}

double DirectionRing::to_next(std::size_t i) const {
  if (i + 1 < directions_.size()) return directions_[i + 1].turn - directions_[i].turn;
  return directions_.front().turn + kFullTurn - directions_[i].turn;
}

void DirectionRing::insert(double x, double y, std::uint32_t point) {
  const double turn = turn_of(x, y);
  const double widest = turn_between(turn, turn_of(x * cos_ - y * sin_, x * sin_ + y * cos_));
  std::size_t place = 0;
  if (!directions_.empty()) {
    const std::size_t before = last_before(turn);
    const double since = turn_between(directions_[before].turn, turn);
    if (std::min(since, to_next(before) - since) < kSame) return;
    if (directions_[before].turn <= turn) place = before + 1;
  }
  directions_.insert(directions_.begin() + static_cast<std::ptrdiff_t>(place),
                     {turn, widest, point});
}

bool DirectionRing::in_gap(double x, double y) const {
  if (directions_.empty()) return true;
  const std::size_t before = last_before(turn_of(x, y));
  return to_next(before) > directions_[before].widest;
}

bool DirectionRing::gap_between(std::size_t from, std::size_t to) const {
  std::size_t i = from;
  do {
    if (to_next(i) > directions_[i].widest) return true;
    i = i + 1 < directions_.size() ? i + 1 : 0;
  } while (i != to);
  return false;
}

}  // namespace burnish
