#include "burnish/pipeline/region.h"

#include <fmt/format.h>

#include <vector>

#include "burnish/base/quantity.h"

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

}  // namespace

bool contains(const Region& region, const Vec3d& point) {
  if (const Box* box = std::get_if<Box>(&region)) {
    return point.x >= box->low.x && point.x <= box->high.x && point.y >= box->low.y &&
           point.y <= box->high.y && point.z >= box->low.z && point.z <= box->high.z;
  }
  const Ball& ball = std::get<Ball>(region);
  return squared_norm(point - ball.centre) <= ball.radius * ball.radius;
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
