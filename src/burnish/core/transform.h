#pragma once

#include "burnish/base/rigid.h"
#include "burnish/core/point_cloud.h"

namespace burnish {

/// The cloud moved by `T`: positions, normals, viewpoint. Missing pixels stay missing. The result
/// is relative to the world's own origin.
PointCloud transformed(PointCloud cloud, const RigidTransform& T);

}  // namespace burnish
