#include "burnish/io/faces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace burnish {
namespace {

struct Point {
  double x, y;
};

/// Twice the signed area of a, b, c: positive where they turn to the left.
double turn(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool inside(const Point& p, const Point& a, const Point& b, const Point& c) {
  return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
}

/// The corners in the plane across the longest axis of the polygon's normal, counter-clockwise.
std::vector<Point> flattened(std::span<const Vec3f> positions,
                             std::span<const std::uint32_t> corners) {
  Vec3d normal{};
  Vec3d previous(positions[corners.back()]);
  for (const std::uint32_t corner : corners) {
    const Vec3d p(positions[corner]);
    normal +=
        Vec3d{(previous.y - p.y) * (previous.z + p.z), (previous.z - p.z) * (previous.x + p.x),
              (previous.x - p.x) * (previous.y + p.y)};
    previous = p;
  }
  const Vec3d size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
  const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  const double sign = normal[axis] < 0 ? -1 : 1;
  std::vector<Point> points;
  points.reserve(corners.size());
  for (const std::uint32_t corner : corners) {
    const Vec3d p(positions[corner]);
    points.push_back({p[u] * sign, p[v]});
  }
  return points;
}

/// Ear clipping on a ring of corners that shrinks by one ear at a time.
class EarClipper {
 public:
  EarClipper(std::span<const std::uint32_t> corners, std::vector<Point> points)
      : corners_(corners),
        points_(std::move(points)),
        next_(corners.size()),
        previous_(corners.size()) {
    const std::size_t count = corners.size();
    for (std::size_t i = 0; i < count; ++i) {
      next_[i] = (i + 1) % count;
      previous_[i] = (i + count - 1) % count;
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (reflex(i)) reflex_.push_back(i);
    }
  }

  bool convex() const { return reflex_.empty(); }

  void clip(std::vector<Triangle>& triangles) {
    std::size_t at = 0;
    std::size_t misses = 0;
    std::size_t left = corners_.size();
    // A ring of which no corner is an ear crosses itself; what is left of it becomes a fan.
    while (left > 3 && misses < left) {
      if (!is_ear(at)) {
        at = next_[at];
        ++misses;
        continue;
      }
      emit(at, triangles);
      remove(at);
      at = next_[at];
      misses = 0;
      --left;
    }
    for (; left > 3; --left) {
      const std::size_t ear = next_[at];
      emit(ear, triangles);
      remove(ear);
    }
    emit(next_[at], triangles);
  }

 private:
  bool reflex(std::size_t i) const {
    return turn(points_[previous_[i]], points_[i], points_[next_[i]]) < 0;
  }

  bool is_ear(std::size_t i) const {
    const Point &a = points_[previous_[i]], &b = points_[i], &c = points_[next_[i]];
    if (!(turn(a, b, c) > 0)) return false;
    return std::none_of(reflex_.begin(), reflex_.end(), [&](std::size_t other) {
      const std::uint32_t vertex = corners_[other];
      return vertex != corners_[previous_[i]] && vertex != corners_[i] &&
             vertex != corners_[next_[i]] && inside(points_[other], a, b, c);
    });
  }

  void emit(std::size_t i, std::vector<Triangle>& triangles) const {
    triangles.push_back({corners_[previous_[i]], corners_[i], corners_[next_[i]]});
  }

  void remove(std::size_t i) {
    next_[previous_[i]] = next_[i];
    previous_[next_[i]] = previous_[i];
    std::erase_if(reflex_, [&](std::size_t other) {
      return other == i || ((other == previous_[i] || other == next_[i]) && !reflex(other));
    });
  }

  std::span<const std::uint32_t> corners_;
  std::vector<Point> points_;
  std::vector<std::size_t> next_, previous_, reflex_;
};

}  // namespace

bool triangulate_polygon(std::span<const Vec3f> positions, std::span<const std::uint32_t> corners,
                         std::vector<Triangle>& triangles) {
  if (corners.size() > 3) {
    EarClipper clipper(corners, flattened(positions, corners));
    if (!clipper.convex()) {
      if (corners.size() > kMaxConcaveCorners) return false;
      clipper.clip(triangles);
      return true;
    }
  }
  for (std::size_t i = 2; i < corners.size(); ++i)
    triangles.push_back({corners[0], corners[i - 1], corners[i]});
  return true;
}

Result<void> FaceList::check(std::int64_t corner) const {
  if (corner >= 0 && static_cast<std::uint64_t>(corner) < positions_.size()) return {};
  return Error{ErrorCode::bad_file,
               fmt::format("face {} names vertex {} of {} (counted from 0)", faces_, corner,
                           positions_.size()),
               {}};
}

Result<void> FaceList::add(std::span<const std::int64_t> corners) {
  for (const std::int64_t corner : corners) {
    if (auto ok = check(corner); !ok) return ok;
  }
  ++faces_;
  if (corners.size() < 3) {
    ++too_small_;
    return {};
  }
  polygon_.assign(corners.begin(), corners.end());
  if (triangulate_polygon(positions_, polygon_, triangles_)) return {};
  return Error{ErrorCode::unsupported,
               fmt::format("face {} is concave with {} corners, at most {} are supported",
                           faces_ - 1, corners.size(), kMaxConcaveCorners),
               {}};
}

Result<void> FaceList::add_strip(std::span<const std::int64_t> corners) {
  std::size_t length = 0;  // of the strip so far
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (corners[i] == -1) {
      length = 0;
      continue;
    }
    if (auto ok = check(corners[i]); !ok) return ok;
    if (++length < 3) continue;
    const auto corner = [&](std::size_t back) {
      return static_cast<std::uint32_t>(corners[i - back]);
    };
    const Triangle triangle = length % 2 == 1 ? Triangle{corner(2), corner(1), corner(0)}
                                              : Triangle{corner(1), corner(2), corner(0)};
    // A corner named twice in a row only steers the strip.
    const bool area =
        triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0];
    if (area) triangles_.push_back(triangle);
  }
  ++faces_;
  return {};
}

void FaceList::note(std::vector<std::string>& notes) const {
  if (too_small_ == 0) return;
  notes.push_back(
      fmt::format("{} of {} faces have fewer than 3 corners and are left out", too_small_, faces_));
}

}  // namespace burnish
