#include "burnish/triangulation/direction_ring.h"

#include <algorithm>
#include <numbers>

namespace burnish {
namespace {

constexpr double kFullTurn = 2 * std::numbers::pi;
/// Directions that differ by less are the same: positions are rounded to float.
constexpr double kSameDirection = 1e-6;

}  // namespace

std::size_t DirectionRing::first_after(double angle) const {
  std::size_t i = 0;
  while (i < directions_.size() && directions_[i].angle <= angle) ++i;
  return i;
}

double DirectionRing::gap_after(std::size_t i) const {
  if (i + 1 < directions_.size()) return directions_[i + 1].angle - directions_[i].angle;
  return directions_.front().angle + kFullTurn - directions_[i].angle;
}

bool DirectionRing::insert(const Direction& direction) {
  const std::size_t place = first_after(direction.angle);
  if (!directions_.empty()) {
    const std::size_t before = (place > 0 ? place : directions_.size()) - 1;
    double since = direction.angle - directions_[before].angle;
    if (since < 0) since += kFullTurn;
    const double gap = gap_after(before);
    if (std::min(since, gap - since) < kSameDirection) return false;
  }
  directions_.insert(directions_.begin() + static_cast<std::ptrdiff_t>(place), direction);
  return true;
}

double DirectionRing::gap_at(double angle) const {
  if (directions_.empty()) return kFullTurn;
  const std::size_t place = first_after(angle);
  return gap_after((place > 0 ? place : directions_.size()) - 1);
}

double DirectionRing::widest_gap(std::size_t from, std::size_t to) const {
  double widest = 0;
  std::size_t i = from;
  do {
    widest = std::max(widest, gap_after(i));
    i = i + 1 < directions_.size() ? i + 1 : 0;
  } while (i != to);
  return widest;
}

double DirectionRing::widest_gap() const {
  return directions_.empty() ? kFullTurn : widest_gap(0, 0);
}

}  // namespace burnish
