#include "burnish/adaptation/removal_replay.h"

#include <fmt/format.h>

#include <algorithm>

namespace burnish {
namespace {

Error refused(std::string message) {
  return {ErrorCode::bad_geometry, std::move(message), {}};
}

}  // namespace

RemovalReplay::RemovalReplay(const TriangleMesh& mesh)
    : triangles_(mesh.triangles),
      gone_(mesh.triangles.size(), false),
      first_(mesh.positions.size(), kNone),
      last_(mesh.positions.size(), kNone),
      next_(3 * mesh.triangles.size(), kNone),
      spokes_(mesh.positions.size()) {
  for (std::uint32_t corner = 0; corner < next_.size(); ++corner) {
    const std::uint32_t v = triangles_[corner / 3][corner % 3];
    (first_[v] == kNone ? first_[v] : next_[last_[v]]) = corner;
    last_[v] = corner;
  }
}

/// Calls `visit` for the triangles at `vertex` that are still there; the others leave its list.
template <class Visit>
void RemovalReplay::for_each_triangle(std::uint32_t vertex, Visit visit) {
  std::uint32_t before = kNone;
  for (std::uint32_t corner = first_[vertex]; corner != kNone; corner = next_[corner]) {
    if (gone_[corner / 3]) {
      (before == kNone ? first_[vertex] : next_[before]) = next_[corner];
    } else {
      visit(corner / 3);
      before = corner;
    }
  }
  last_[vertex] = before;
}

/// The third corner of a triangle that names `a` and `b`.
std::uint32_t RemovalReplay::corner_beside(std::uint32_t triangle, std::uint32_t a,
                                           std::uint32_t b) const {
  const Triangle& t = triangles_[triangle];
  return t[0] != a && t[0] != b ? t[0] : t[1] != a && t[1] != b ? t[1] : t[2];
}

/// The triangles around `vertex` and the edges between them; false where one names a vertex twice
/// or an edge has more than two.
bool RemovalReplay::collect_star(std::uint32_t vertex) {
  star_.clear();
  bool sound = true;
  for_each_triangle(vertex, [&](std::uint32_t t) {
    const auto place = static_cast<std::uint32_t>(star_.size());
    star_.push_back(t);
    const auto [a, b, c] = triangles_[t];
    sound = sound && a != b && b != c && c != a;
    for (const std::uint32_t rim : triangles_[t]) {
      if (rim == vertex) continue;
      Spoke& spoke = spokes_[rim];
      sound = sound && spoke.second == kNone;
      (spoke.first == kNone ? spoke.first : spoke.second) = place;
    }
  });
  return sound;
}

void RemovalReplay::clear_spokes(std::uint32_t vertex) {
  for (const std::uint32_t t : star_) {
    for (const std::uint32_t v : triangles_[t]) spokes_[v] = {};
  }
  spokes_[vertex] = {};
}

/// Walks around the star from `into` and leaves the triangles in `ordered_` as Star has them.
Result<StarShape> RemovalReplay::order_star(const Removal& removal) {
  const auto [v, into, error] = removal;
  const Spoke start = spokes_[into];
  if (start.first == kNone)
    return refused(fmt::format("no edge joins vertices {} and {}", v, into));
  ordered_.clear();
  std::uint32_t rim = into, place = start.first;
  do {
    ordered_.push_back(star_[place]);
    rim = corner_beside(star_[place], v, rim);
    const Spoke& spoke = spokes_[rim];
    place = spoke.first == place ? spoke.second : spoke.first;
  } while (place != kNone && rim != into);

  const bool closed = rim == into;
  if (ordered_.size() != star_.size() || (closed && star_.size() < 3)) {
    // The walk from within an open fan ends at its boundary and has not seen all.
    const bool within = !closed && start.second != kNone;
    return refused(
        within ? fmt::format("vertex {} is on the boundary, but its edge to {} is not", v, into)
               : fmt::format("the triangles around vertex {} are not one fan", v));
  }
  if (!closed) return star_.size() == 1 ? StarShape::ear : StarShape::open;
  std::rotate(ordered_.begin(), ordered_.end() - 1, ordered_.end());
  return StarShape::closed;
}

/// Whether all that the two vertices have in common are their triangles; finds the one beyond an
/// ear.
Result<void> RemovalReplay::check_link(const Removal& removal, StarShape shape) {
  const std::uint32_t v = removal.vertex, into = removal.into;
  const std::uint32_t left = corner_beside(ordered_.front(), v, into);
  const std::uint32_t right =
      shape == StarShape::closed ? corner_beside(ordered_[1], v, into) : left;
  std::uint32_t common = kNone, beyond = kNone;
  int beyond_count = 0;
  bool twice = false;
  for_each_triangle(into, [&](std::uint32_t t) {
    const Triangle& corners = triangles_[t];
    if (std::find(corners.begin(), corners.end(), v) != corners.end()) return;
    int lefts = 0, rights = 0;
    for (const std::uint32_t other : corners) {
      if (other == into || spokes_[other].first == kNone) continue;
      lefts += other == left;
      rights += other == right;
      if (other != left && other != right) common = other;
    }
    twice = twice || (ordered_.size() == 3 && left != right && lefts > 0 && rights > 0);
    if (lefts > 0) beyond = t;
    beyond_count += lefts;  // a triangle that names a vertex twice has the edge twice
  });
  if (common != kNone) {
    return refused(fmt::format(
        "vertices {} and {} have the neighbour {} in common, but no triangle", v, into, common));
  }
  if (twice) {
    return refused(fmt::format("without vertex {} there would be two triangles {}, {}, {}", v, into,
                               left, right));
  }
  if (shape != StarShape::ear) return {};
  if (beyond_count != 1) {
    return refused(
        fmt::format("the triangle of vertex {} has {} others beyond its edge from {} to "
                    "{}, not one",
                    v, beyond_count, into, left));
  }
  ordered_.push_back(beyond);
  return {};
}

Result<StarShape> RemovalReplay::find_star(const Removal& removal) {
  if (!collect_star(removal.vertex)) {
    return refused(fmt::format("the triangles around vertex {} are not one fan", removal.vertex));
  }
  const Result<StarShape> shape = order_star(removal);
  if (!shape) return shape;
  if (auto free = check_link(removal, *shape); !free) return std::move(free).error();
  return shape;
}

void RemovalReplay::rename(const Removal& removal, StarShape shape) {
  const auto [v, into, error] = removal;
  for (const std::uint32_t t : star_)
    std::replace(triangles_[t].begin(), triangles_[t].end(), v, into);
  gone_[ordered_[0]] = true;
  if (shape == StarShape::closed) gone_[ordered_[1]] = true;
  next_[last_[into]] = first_[v];
  last_[into] = last_[v];
  first_[v] = last_[v] = kNone;
}

Result<Star> RemovalReplay::apply(const Removal& removal) {
  const auto [v, into, error] = removal;
  if (v >= first_.size() || into >= first_.size()) {
    return refused(fmt::format("vertices {} and {} of {}", v, into, first_.size()));
  }
  const Result<StarShape> shape = find_star(removal);
  clear_spokes(v);
  if (!shape) return shape.error();
  rename(removal, *shape);
  return Star{*shape, ordered_};
}

}  // namespace burnish
