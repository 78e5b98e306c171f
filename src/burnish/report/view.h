#pragma once

#include <string>
#include <vector>

#include "burnish/base/rigid.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// From where a picture is taken, in perspective, and how wide it sees.
struct View {
  std::string name;               ///< "three-quarter"
  RigidTransform T_world_camera;  ///< camera axes: x right, y down, z forward; world m
  double half_height = 0.25;      ///< tangent of half the vertical field of view, > 0
};

/// The view along `forward` that shows the whole mesh as large as a picture of `aspect` (width /
/// height) allows, with a small margin; `up` points to its top. One vertex in a thousand may be
/// left outside on each side, so that a stray point does not make the rest small. Vertices that no
/// triangle uses do not count. An empty mesh is looked at from a metre away. O(#V + #T).
View framing_view(std::string name, const TriangleMesh& mesh, const Vec3d& forward, const Vec3d& up,
                  double aspect);

/// Three views that together show most of a surface: front, three-quarter and top. `forward` is the
/// direction in which the front view looks; `up` must not be parallel to it.
std::vector<View> standard_views(const TriangleMesh& mesh, const Vec3d& forward, const Vec3d& up,
                                 double aspect);

/// A narrower view in the direction of `wide`, of the nearest surface around its middle, away from
/// boundaries where there is such; about 18 edges of median length are as high as the picture.
/// O(#V + #T).
View close_up(const TriangleMesh& mesh, const View& wide);

}  // namespace burnish
