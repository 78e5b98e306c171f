#pragma once

#include "burnish/base/rigid.h"
#include "burnish/core/point_cloud.h"

namespace burnish {

/// The frame to keep positions around `place` in: the world's own where float is fine enough for
/// them (within 100 m: steps of 8 um), else one whose origin is `place` in whole metres.
Frame frame_near(const Vec3d& place);

/// The cloud moved by `T`, a world to another: positions, normals, the axes of
/// the noise, viewpoint. Missing pixels stay
/// missing; an organized cloud without a viewpoint was seen from the origin. The result is relative
/// to the frame_near of where its own origin goes.
PointCloud transformed(PointCloud cloud, const RigidTransform& T);

}  // namespace burnish
