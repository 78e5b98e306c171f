#pragma once

#include <span>
#include <vector>

#include "burnish/triangulation/key_sort.h"
#include "burnish/triangulation/predicates.h"

namespace burnish {

/// `points` along a space-filling curve (Morton 1966) through the cells of a quadtree over their
/// square: of two keys the highest bit that differs says where a line parts the points, upright for
/// even bits and level for odd ones. Points of one cell come by x, then by y, then by index, so
/// that coincident points are next to each other. O(#P log #P) at worst, O(#P) where few share a
/// cell.
std::vector<Keyed> order_in_plane(std::span<const Vec2d> points);

}  // namespace burnish
