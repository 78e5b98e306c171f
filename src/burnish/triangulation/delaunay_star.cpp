#include "burnish/triangulation/delaunay_star.h"

#include <algorithm>
#include <cmath>

#include "burnish/base/small_sort.h"

namespace burnish {
namespace {

/// Two directions are the same, or opposite, where the sine of their angle is less.
constexpr double kSameDirection = 1e-6;
/// The circles through the origin and a, b and through it and b, c are the same where they meet
/// under a smaller angle: positions are rounded to float.
constexpr double kSameCircle = 1e-5;

template <class Point>
double cross(const Point& a, const Point& b) {
  return a.x * b.y - a.y * b.x;
}

template <class Point>
double dot(const Point& a, const Point& b) {
  return a.x * b.x + a.y * b.y;
}

/// Whether b is less than half a turn counter-clockwise from a, and more than nothing.
template <class Point>
bool is_left(const Point& a, const Point& b) {
  const double area = cross(a, b);
  return area > 0 &&
         area * area > kSameDirection * kSameDirection * a.squared_norm * b.squared_norm;
}

enum class Turn { right, straight, left };

/// How the way from a by b to c turns at b.
template <class Point>
Turn turn(const Point& a, const Point& b, const Point& c) {
  const double ux = b.x - a.x, uy = b.y - a.y, vx = c.x - b.x, vy = c.y - b.y;
  const double area = ux * vy - uy * vx;
  const double straight = kSameCircle * kSameCircle * (ux * ux + uy * uy) * (vx * vx + vy * vy);
  if (area * area <= straight) return Turn::straight;
  return area > 0 ? Turn::left : Turn::right;
}

}  // namespace

void DelaunayStar::sort_around(const std::vector<PlanePoint>& points) {
  rays_.resize(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const PlanePoint& p = points[i];
    const double part = p.y / (std::abs(p.x) + std::abs(p.y));
    rays_[i] = {p.x < 0 ? 2 - part : p.y < 0 ? 4 + part : part, i, p.index};
  }
  small_sort(
      std::span(rays_), [](const Ray& ray) { return static_cast<float>(ray.direction); },
      [](const Ray& a, const Ray& b) {
        return a.direction != b.direction ? a.direction < b.direction : a.index < b.index;
      });
}

/// Of the points in one direction the nearest stays.
void DelaunayStar::invert(const std::vector<PlanePoint>& points) {
  around_.clear();
  for (const Ray& ray : rays_) {
    const PlanePoint& p = points[ray.number];
    const double scale = 1 / dot(p, p);  // and the square of the inverted point's norm
    const Inverted inverted{p.x * scale, p.y * scale, scale, ray.number, ray.index};
    const bool same =
        !around_.empty() && !is_left(around_.back(), inverted) && dot(around_.back(), inverted) > 0;
    if (!same) {
      around_.push_back(inverted);
    } else if (inverted.squared_norm > around_.back().squared_norm) {
      around_.back() = inverted;
    }
  }
}

/// Begins behind the gap of half a turn or more where there is one, else with the nearest point,
/// which is joined to the origin in every Delaunay triangulation.
std::size_t DelaunayStar::find_start() {
  std::size_t nearest = 0;
  closed_ = around_.size() > 2;
  for (std::size_t i = 0; i < around_.size(); ++i) {
    const std::size_t next = i + 1 < around_.size() ? i + 1 : 0;
    if (!is_left(around_[i], around_[next])) {
      closed_ = false;
      return next;
    }
    if (around_[i].squared_norm > around_[nearest].squared_norm) nearest = i;
  }
  return nearest;
}

/// Points on the hull's sides stay: their circles are the same.
void DelaunayStar::walk_around_hull(std::size_t start) {
  hull_.clear();
  const auto visit = [&](const Inverted& p) {
    while (hull_.size() > 1 && turn(hull_[hull_.size() - 2], hull_.back(), p) == Turn::right) {
      hull_.pop_back();
    }
    hull_.push_back(p);
  };
  for (std::size_t i = start; i < around_.size(); ++i) visit(around_[i]);
  for (std::size_t i = 0; i < start; ++i) visit(around_[i]);
  if (!closed_) return;
  visit(around_[start]);
  hull_.pop_back();
}

/// Along a side of the hull the star keeps all points where the origin has the smallest index of
/// the circle, else the ends and the one that has it.
void DelaunayStar::settle_circles(std::uint32_t centre) {
  rim_.clear();
  const std::size_t count = hull_.size(), corners = closed_ ? count + 1 : count;
  const auto at = [&](std::size_t i) -> const Inverted& {
    return hull_[i < count ? i : i - count];
  };
  for (std::size_t begin = 0; begin + 1 < corners;) {
    std::size_t end = begin + 1, first = begin;
    for (;; ++end) {
      if (at(end).index < at(first).index) first = end;
      if (end + 1 >= corners || turn(at(end - 1), at(end), at(end + 1)) != Turn::straight) break;
    }
    for (std::size_t i = begin; i < end; ++i) {
      if (i == begin || i == first || centre < at(first).index) rim_.push_back(at(i).number);
    }
    begin = end;
  }
  if (!closed_) rim_.push_back(hull_.back().number);
}

void DelaunayStar::measure() {
  squared_diameter_ = 0;
  const std::size_t count = hull_.size();
  for (std::size_t i = closed_ ? 0 : 1; i < count; ++i) {
    const Inverted &a = hull_[i > 0 ? i - 1 : count - 1], &b = hull_[i];
    const double dx = b.x - a.x, dy = b.y - a.y, area = cross(a, b);
    squared_diameter_ = std::max(squared_diameter_, (dx * dx + dy * dy) / (area * area));
  }
}

void DelaunayStar::build(const std::vector<PlanePoint>& points, std::uint32_t centre) {
  rim_.clear();
  closed_ = false;
  squared_diameter_ = 0;
  if (points.empty()) return;
  sort_around(points);
  invert(points);
  const std::size_t start = find_start();
  walk_around_hull(start);
  const bool on_a_line = hull_.size() == 2 && !is_left(hull_[0], hull_[1]);
  if (on_a_line) hull_.pop_back();
  settle_circles(centre);
  measure();
}

}  // namespace burnish
