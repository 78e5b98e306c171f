#pragma once

#include <span>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/core/triangle_mesh.h"
#include "burnish/triangulation/key_sort.h"
#include "burnish/triangulation/predicates.h"

namespace burnish {

/// The Delaunay triangulation of points of a plane, the one that predicates.h makes unique; it
/// covers their convex hull. `order` names the points that take part, which are distinct, as
/// order_in_plane() gives them. `triangles` gets indices into `points`: counter-clockwise, the
/// smallest first, sorted. None where all points are on a line.
///
/// By divide and conquer (Guibas and Stolfi 1985) along the quadtree, so with cuts in both
/// directions (Dwyer 1987). O(#P log #P) for whatever points; parts are built in parallel. Takes 72
/// bytes a point. Returns false where cancelled.
bool planar_delaunay(std::span<const Vec2d> points, std::span<const Keyed> order,
                     const Context& context, std::vector<Triangle>& triangles);

}  // namespace burnish
