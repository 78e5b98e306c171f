#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "burnish/base/result.h"
#include "burnish/base/vec3.h"

namespace burnish {

/// An axis-parallel box, corners included; m.
struct Box {
  Vec3d low, high;
};

/// A ball; m.
struct Ball {
  Vec3d centre;
  double radius = 0;
};

/// A part of space.
using Region = std::variant<Box, Ball>;

bool contains(const Region& region, const Vec3d& point);

/// Whether a point of the triangle abc, which may be a segment or a point, lies in `region`; at its
/// surface that is up to rounding.
bool meets(const Region& region, const Vec3d& a, const Vec3d& b, const Vec3d& c);

/// Reads "box:x0,y0,z0,x1,y1,z1" or "sphere:x,y,z,radius"; each number may carry a unit (20cm).
/// Errors: invalid_argument with the text and the forms that would do.
Result<Region> parse_region(std::string_view text);

/// The text, in metres, that parse_region reads back as `region`.
std::string to_string(const Region& region);

}  // namespace burnish
