#include "burnish/triangulation/point_order.h"

#include <algorithm>

#include "burnish/triangulation/key_sort.h"

namespace burnish {
namespace {

/// Spreads the lower 21 bits of `x` to every third bit.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x1f00000000ffff;
  x = (x | x << 16) & 0x1f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}

}  // namespace

std::vector<std::uint32_t> order_along_curve(std::span<const Vec3f> points) {
  std::vector<Keyed> items;
  items.reserve(points.size());
  Vec3d low, high;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (!is_finite(points[i])) continue;
    const Vec3d p(points[i]);
    if (items.empty()) low = high = p;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
    items.push_back({0, i});
  }
  const Vec3d size = high - low;
  const double extent = std::max({size.x, size.y, size.z});
  const double scale = extent > 0 ? 2097151 / extent : 0;
  for (Keyed& item : items) {
    const Vec3d cell = (Vec3d(points[item.index]) - low) * scale;
    item.key = spread(static_cast<std::uint64_t>(cell.x)) |
               spread(static_cast<std::uint64_t>(cell.y)) << 1 |
               spread(static_cast<std::uint64_t>(cell.z)) << 2;
  }
  sort_by_key(items);
  // Points of one cell of the curve: by coordinates, so that only coincident ones follow the index.
  const auto before = [&](const Keyed& a, const Keyed& b) {
    const Vec3f &p = points[a.index], &q = points[b.index];
    if (p.x != q.x) return p.x < q.x;
    if (p.y != q.y) return p.y < q.y;
    return p.z != q.z ? p.z < q.z : a.index < b.index;
  };
  sort_equal_keys(items, before);
  std::vector<std::uint32_t> order;
  order.reserve(items.size());
  for (const Keyed& item : items) {
    if (order.empty() || points[order.back()] != points[item.index]) order.push_back(item.index);
  }
  return order;
}

}  // namespace burnish
