#include "burnish/core/transform.h"

namespace burnish {

PointCloud transformed(PointCloud cloud, const RigidTransform& T) {
  for (Vec3f& p : cloud.positions) {
    if (is_finite(p)) p = Vec3f(T(cloud.frame.origin + Vec3d(p)));
  }
  for (Vec3f& n : cloud.attributes.normals) n = Vec3f(T.rotate(Vec3d(n)));
  if (cloud.viewpoint) cloud.viewpoint = T(*cloud.viewpoint);
  cloud.frame = {};
  return cloud;
}

}  // namespace burnish
