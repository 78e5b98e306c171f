#pragma once

#include <numbers>

#include "burnish/base/context.h"
#include "burnish/base/schema.h"
#include "burnish/core/point_cloud.h"
#include "burnish/triangulation/triangulation.h"

namespace burnish {

/// What a surface of one sheet is looked at along.
enum class Projection {
  plane,  ///< the normal of the plane of least squares through the points
  x,
  y,
  z,     ///< an axis
  view,  ///< the rays of a camera at the cloud's viewpoint
};

struct DelaunayParams {
  Projection projection = Projection::plane;
  double max_edge = 0;                      ///< m; 0: any
  double max_angle = std::numbers::pi / 2;  ///< between normal and line of sight; pi/2: any

  static const Schema<DelaunayParams>& schema();
};

/// The Delaunay triangulation of the points in a projection, lifted back to them (2.5D): for scans
/// of one sheet, terrain, reliefs. Shapes with a front and a back get a wrong surface from it.
///
/// The viewer is on the viewpoint's side where the cloud names one, else on the side that most
/// normals look to, else where the axis points (a plane's normal has z > 0). Triangles are
/// counter-clockwise for the viewer. `view` is a pinhole camera at the viewpoint that looks at the
/// mean of the points, and asks for all of them within 89 degrees of that. Of points that fall on
/// one in the projection the nearest to the viewer stays, of coincident ones the first.
///
/// The predicates are exact (predicates.h), so that the triangles are Delaunay to the last bit, and
/// of four points on one circle the choice is by their coordinates: it depends neither on the order
/// of the points nor on anything else. They cover the convex hull, but where `max_edge` or
/// `max_angle` drops long or steep ones; patches may then touch in a vertex. `plane` and `view`
/// round coordinates to 2^-32 of the largest; triangles not thicker than that are left out.
///
/// Points that no triangle uses are left out, attributes are carried; missing pixels of an
/// organized cloud are skipped. Triangles are sorted by their smallest index. O(#P log #P). Errors:
/// invalid_argument; bad_geometry, also where `view` lacks a viewpoint or has points beside or
/// behind it; cancelled.
Result<Triangulation> triangulate_delaunay(const PointCloud& cloud,
                                           const DelaunayParams& params = {},
                                           const Context& context = {});

}  // namespace burnish
