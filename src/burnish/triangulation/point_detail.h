#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "burnish/base/vec3.h"

namespace burnish {

/// A place and a direction as seen from points around: their mean, the normal of the polygon that
/// they are in their order, and the direction to the first. It follows where these points are moved
/// and turned together; where they span no plane, where they are moved.
struct PointDetail {
  Vec3f offset, normal;
};

/// The points in an order in which they make a good frame: the farthest from their mean first.
/// `around`: as they follow each other.
void order_for_detail(std::span<const Vec3f> positions, std::vector<std::uint32_t>& around);

PointDetail detail_of(const Vec3f& position, const Vec3f& normal, std::span<const Vec3f> positions,
                      std::span<const std::uint32_t> around);

/// The inverse: position and normal from where the points around are now.
void place_detail(const PointDetail& detail, std::span<const Vec3f> positions,
                  std::span<const std::uint32_t> around, Vec3f& position, Vec3f& normal);

}  // namespace burnish
