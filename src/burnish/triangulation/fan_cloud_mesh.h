#pragma once

#include "burnish/base/context.h"
#include "burnish/core/point_cloud.h"
#include "burnish/triangulation/fan_cloud_params.h"
#include "burnish/triangulation/triangulation.h"

namespace burnish {

/// The fan cloud (fan_cloud.h) of a cloud's points, drawn as a mesh whose triangles know their
/// owner, the vertex whose fan they are of. `cover`: each triangle once, and only so many as cover
/// the surface (fan_cover.h), about two a point. `all`: all of every fan, about six a point, most
/// of them three times. Fans do not ask each other: where they disagree, triangles overlap.
///
/// Normals are used where the cloud has them. Where it has none, fans lie in planes of least
/// squares, and their triangles face towards the viewpoint or, without one, to one side by the rule
/// of estimate_normals. Points without a triangle and all but one of coincident points are left out
/// and counted; attributes are carried; missing pixels of an organized cloud are skipped. The
/// triangles do not depend on the order of the points. O(#P k log k).
/// Errors: invalid_argument, bad_geometry, cancelled.
Result<Triangulation> triangulate_fan_cloud(const PointCloud& cloud,
                                            const FanCloudParams& params = {},
                                            const Context& context = {});

}  // namespace burnish
