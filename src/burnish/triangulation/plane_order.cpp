#include "burnish/triangulation/plane_order.h"

#include <algorithm>

namespace burnish {
namespace {

/// Spreads 32 bits to every second bit.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 16) & 0x0000ffff0000ffff;
  x = (x | x << 8) & 0x00ff00ff00ff00ff;
  x = (x | x << 4) & 0x0f0f0f0f0f0f0f0f;
  x = (x | x << 2) & 0x3333333333333333;
  return (x | x << 1) & 0x5555555555555555;
}

}  // namespace

std::vector<Keyed> order_in_plane(std::span<const Vec2d> points) {
  std::vector<Keyed> items;
  if (points.empty()) return items;
  Vec2d low = points.front(), high = low;
  for (const Vec2d& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const double extent = std::max(high.x - low.x, high.y - low.y);
  const double scale = extent > 0 ? 4294967295 / extent : 0;
  items.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const auto column = static_cast<std::uint64_t>((points[i].x - low.x) * scale);
    const auto row = static_cast<std::uint64_t>((points[i].y - low.y) * scale);
    items.push_back({spread(column) | spread(row) << 1, i});
  }
  sort_by_key(items);
  sort_equal_keys(items, [&](const Keyed& a, const Keyed& b) {
    const Vec2d &p = points[a.index], &q = points[b.index];
    return p == q ? a.index < b.index : lexicographically_less(p, q);
  });
  return items;
}

}  // namespace burnish
