#include "burnish/triangulation/delaunay_star.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace burnish {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
/// Cotangents that differ by less are those of one circle: positions are rounded to float.
constexpr double kSameCircle = 1e-5;

double cross(const PlanePoint& a, const PlanePoint& b) {
  return a.x * b.y - a.y * b.x;
}

}  // namespace

/// The third corner of the Delaunay triangle on the left of the edge from the origin to `from` (on
/// its right for sign -1): the point that sees the edge under the widest angle.
std::uint32_t DelaunayStar::next(const std::vector<PlanePoint>& points, std::uint32_t from,
                                 std::uint32_t centre, double sign) {
  const PlanePoint& c = points[from];
  double least = std::numeric_limits<double>::infinity();
  tied_.clear();
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const PlanePoint& q = points[i];
    const double side = sign * cross(c, q);
    if (!(side > 0)) continue;
    const double cotangent = (q.x * (q.x - c.x) + q.y * (q.y - c.y)) / side;
    const double tolerance = kSameCircle * (1 + std::abs(least));
    if (cotangent > least + tolerance) continue;
    if (!(cotangent >= least - tolerance)) tied_.clear();
    least = std::min(least, cotangent);
    tied_.push_back(i);
  }
  if (tied_.empty()) return kNone;
  squared_diameter_ = std::max(squared_diameter_, (c.x * c.x + c.y * c.y) * (1 + least * least));
  if (tied_.size() == 1) return tied_[0];
  // One circle through the origin, `from` and the tied points, in this order around it by angle.
  std::sort(tied_.begin(), tied_.end(), [&](std::uint32_t a, std::uint32_t b) {
    const double turn = sign * cross(points[a], points[b]);
    return turn != 0 ? turn > 0 : points[a].index < points[b].index;
  });
  const auto apex = *std::min_element(tied_.begin(), tied_.end(), [&](auto a, auto b) {
    return points[a].index < points[b].index;
  });
  if (centre < std::min(c.index, points[apex].index)) return tied_.front();
  return c.index < points[apex].index ? tied_.back() : apex;
}

void DelaunayStar::walk(const std::vector<PlanePoint>& points, std::uint32_t centre, Turn turn) {
  const double sign = turn == Turn::counter_clockwise ? 1 : -1;
  for (std::uint32_t at = rim_.back();;) {
    at = next(points, at, centre, sign);
    if (at == kNone) return;
    if (on_rim_[at]) {
      closed_ = closed_ || (at == rim_.front() && rim_.size() > 2);
      return;
    }
    on_rim_[at] = true;
    rim_.push_back(at);
  }
}

void DelaunayStar::build(const std::vector<PlanePoint>& points, std::uint32_t centre) {
  rim_.clear();
  on_rim_.assign(points.size(), false);
  closed_ = false;
  squared_diameter_ = 0;
  if (points.empty()) return;
  // The nearest point is joined to the origin in every Delaunay triangulation.
  std::uint32_t nearest = 0;
  const auto squared = [](const PlanePoint& p) { return p.x * p.x + p.y * p.y; };
  for (std::uint32_t i = 1; i < points.size(); ++i) {
    const double here = squared(points[i]), best = squared(points[nearest]);
    if (here < best || (here == best && points[i].index < points[nearest].index)) nearest = i;
  }
  rim_.push_back(nearest);
  on_rim_[nearest] = true;
  walk(points, centre, Turn::counter_clockwise);
  if (closed_) return;
  std::reverse(rim_.begin(), rim_.end());
  walk(points, centre, Turn::clockwise);
  closed_ = false;
  std::reverse(rim_.begin(), rim_.end());
}

}  // namespace burnish
