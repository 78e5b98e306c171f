#include "burnish/triangulation/hull_merge.h"

namespace burnish {

std::uint32_t HullMerger::add_edge(std::uint32_t from, std::uint32_t to) {
  while (slots_.front().empty()) slots_ = slots_.subspan(1);
  const std::uint32_t edge = slots_.front().take();
  edges_.make(edge, from, to);
  return edge;
}

void HullMerger::remove_edge(std::uint32_t e) {
  edges_.detach(e);
  slots_.front().give_back(e);
}

/// The edge of the hull that leaves its utmost point; on a convex hull the way there is uphill.
template <class Beyond>
std::uint32_t HullMerger::extreme(std::uint32_t e, Beyond beyond) const {
  while (beyond(at(edges_.destination(e)), at(edges_.origin(e)))) e = edges_.right_next(e);
  for (;;) {
    const std::uint32_t before = edges_.right_previous(e);
    if (!beyond(at(edges_.origin(before)), at(edges_.origin(e)))) return e;
    e = before;
  }
}

/// A new edge from the right to the left part that has both above it, on its right.
std::uint32_t HullMerger::lower_tangent(const HullPart& left, const HullPart& right, Cut cut) {
  const auto less = [cut](const Vec2d& a, const Vec2d& b) {
    if (cut == Cut::upright) return lexicographically_less(a, b);
    return a.y != b.y ? a.y < b.y : a.x > b.x;
  };
  std::uint32_t l = left.point, r = right.point;
  std::uint32_t of_left = kNoEdge, of_right = kNoEdge;  // the next edges of the hulls downwards
  if (left.hull != kNoEdge) {
    const auto more = [&](const Vec2d& a, const Vec2d& b) { return less(b, a); };
    of_left = edges_.previous(extreme(left.hull, more));
    l = edges_.origin(of_left);
  }
  if (right.hull != kNoEdge) {
    of_right = extreme(right.hull, less);
    r = edges_.origin(of_right);
  }
  for (;;) {
    if (of_left != kNoEdge && counter_clockwise(at(r), at(l), at(edges_.destination(of_left)))) {
      of_left = edges_.left_next(of_left);
      l = edges_.origin(of_left);
    } else if (of_right != kNoEdge &&
               counter_clockwise(at(l), at(edges_.destination(of_right)), at(r))) {
      of_right = edges_.right_next(of_right);
      r = edges_.origin(of_right);
    } else {
      break;
    }
  }
  const std::uint32_t base = add_edge(r, l);
  if (of_right != kNoEdge) edges_.insert_after(base, edges_.previous(of_right));
  if (of_left != kNoEdge) edges_.insert_after(base ^ 1, of_left);
  return base;
}

/// The first edge above `base` at the end that `from` leaves (the base, or its other half), after
/// those went that the circle through base and apex shows not to be Delaunay edges.
template <class Turn>
HullMerger::Candidate HullMerger::clear(std::uint32_t base, std::uint32_t from, Turn turn) {
  const std::uint32_t l = edges_.destination(base), r = edges_.origin(base);
  Candidate candidate{turn(from), 0, false};
  if (candidate.edge == from) return candidate;
  candidate.apex = edges_.destination(candidate.edge);
  candidate.above = counter_clockwise(at(l), at(r), at(candidate.apex));
  if (!candidate.above) return candidate;
  for (;;) {
    const std::uint32_t following = turn(candidate.edge);
    if (following == from) return candidate;
    const std::uint32_t apex = edges_.destination(following);
    if (!in_circle(at(l), at(r), at(candidate.apex), at(apex))) return candidate;
    remove_edge(candidate.edge);
    candidate.edge = following;
    candidate.apex = apex;
  }
}

/// The next edge between the parts above `base`; none above the upper tangent.
std::uint32_t HullMerger::rise(std::uint32_t base) {
  const std::uint32_t l = edges_.destination(base), r = edges_.origin(base);
  const Candidate left = clear(base, base ^ 1, [this](std::uint32_t e) { return edges_.next(e); });
  const Candidate right = clear(base, base, [this](std::uint32_t e) { return edges_.previous(e); });
  if (!left.above && !right.above) return kNoEdge;
  const bool to_right =
      !left.above || (right.above && in_circle(at(left.apex), at(l), at(r), at(right.apex)));
  if (to_right) {
    const std::uint32_t rung = add_edge(right.apex, l);
    edges_.insert_after(rung, edges_.left_next(right.edge));
    edges_.insert_after(rung ^ 1, base ^ 1);
    return rung;
  }
  const std::uint32_t rung = add_edge(r, left.apex);
  edges_.insert_after(rung, edges_.previous(base));
  edges_.insert_after(rung ^ 1, left.edge ^ 1);
  return rung;
}

HullPart HullMerger::join(std::uint32_t a, std::uint32_t b) {
  return {a, add_edge(a, b)};
}

HullPart HullMerger::merge(const HullPart& left, const HullPart& right, Cut cut) {
  std::uint32_t rung = lower_tangent(left, right, cut);
  const HullPart merged{left.point, rung ^ 1};
  while (rung != kNoEdge) rung = rise(rung);
  return merged;
}

}  // namespace burnish
