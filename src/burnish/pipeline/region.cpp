#include "burnish/pipeline/region.h"

#include <fmt/format.h>

#include <vector>

#include "burnish/base/quantity.h"
#include "burnish/spatial/closest_point.h"

namespace burnish {
namespace {

Result<std::vector<double>> parse_lengths(std::string_view text) {
  std::vector<double> values;
  while (true) {
    const std::size_t comma = text.find(',');
    const Result<double> value = parse_quantity(text.substr(0, comma), Quantity::length);
    if (!value) return value.error();
    values.push_back(*value);
    if (comma == std::string_view::npos) return values;
    text.remove_prefix(comma + 1);
  }
}

/// What is left of a polygon where `height(corner)` is not negative (Sutherland and Hodgman 1974).
template <class Height>
std::vector<Vec3d> clipped(const std::vector<Vec3d>& polygon, Height height) {
  std::vector<Vec3d> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3d &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    const double start = height(from), end = height(to);
    if (start >= 0) kept.push_back(from);
    if ((start >= 0) != (end >= 0)) kept.push_back(from + (to - from) * (start / (start - end)));
  }
  return kept;
}

bool meets(const Box& box, std::vector<Vec3d> polygon) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    polygon = clipped(polygon, [&](const Vec3d& p) { return p[axis] - box.low[axis]; });
    polygon = clipped(polygon, [&](const Vec3d& p) { return box.high[axis] - p[axis]; });
  }
  return !polygon.empty();
}

}  // namespace

bool contains(const Region& region, const Vec3d& point) {
  if (const Box* box = std::get_if<Box>(&region)) {
    return point.x >= box->low.x && point.x <= box->high.x && point.y >= box->low.y &&
           point.y <= box->high.y && point.z >= box->low.z && point.z <= box->high.z;
  }
  const Ball& ball = std::get<Ball>(region);
  return squared_norm(point - ball.centre) <= ball.radius * ball.radius;
}

bool meets(const Region& region, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  if (const Box* box = std::get_if<Box>(&region)) {
    if (contains(region, a) || contains(region, b) || contains(region, c)) return true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (a[axis] < box->low[axis] && b[axis] < box->low[axis] && c[axis] < box->low[axis])
        return false;
      if (a[axis] > box->high[axis] && b[axis] > box->high[axis] && c[axis] > box->high[axis])
        return false;
    }
    return meets(*box, {a, b, c});
  }
  return contains(region, closest_on_triangle(std::get<Ball>(region).centre, a, b, c));
}

Result<Region> parse_region(std::string_view text) {
  const Error malformed{
      ErrorCode::invalid_argument,
      fmt::format("'{}' is neither box:x0,y0,z0,x1,y1,z1 nor sphere:x,y,z,radius", text),
      {}};
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return malformed;
  const std::string_view kind = text.substr(0, colon);
  const Result<std::vector<double>> numbers = parse_lengths(text.substr(colon + 1));
  if (!numbers) return numbers.error();
  const std::vector<double>& v = *numbers;
  if (kind == "box" && v.size() == 6) {
    const Box box{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
    if (box.low.x < box.high.x && box.low.y < box.high.y && box.low.z < box.high.z)
      return Region{box};
    return Error{ErrorCode::invalid_argument,
                 fmt::format("'{}' is empty: the first corner must be below the second", text),
                 {}};
  }
  if (kind == "sphere" && v.size() == 4) {
    if (v[3] > 0) return Region{Ball{{v[0], v[1], v[2]}, v[3]}};
    return Error{ErrorCode::invalid_argument,
                 fmt::format("'{}' is empty: the radius must be positive", text),
                 {}};
  }
  return malformed;
}

std::string to_string(const Region& region) {
  if (const Box* box = std::get_if<Box>(&region)) {
    return fmt::format("box:{},{},{},{},{},{}", box->low.x, box->low.y, box->low.z, box->high.x,
                       box->high.y, box->high.z);
  }
  const Ball& ball = std::get<Ball>(region);
  return fmt::format("sphere:{},{},{},{}", ball.centre.x, ball.centre.y, ball.centre.z,
                     ball.radius);
}

}  // namespace burnish
