#include "burnish/core/transform.h"

#include <cmath>

namespace burnish {

Frame frame_near(const Vec3d& place) {
  constexpr double kFar = 100;
  if (norm(place) < kFar) return {};
  return {{std::round(place.x), std::round(place.y), std::round(place.z)}};
}

PointCloud transformed(PointCloud cloud, const RigidTransform& T) {
  const Frame frame = frame_near(T(cloud.frame.origin));
  for (Vec3f& p : cloud.positions) {
    if (is_finite(p)) p = Vec3f(T(cloud.frame.origin + Vec3d(p)) - frame.origin);
  }
  for (Vec3f& n : cloud.attributes.normals) n = Vec3f(T.rotate(Vec3d(n)));
  for (PointNoise& noise : cloud.attributes.noise) {
    noise.axis = Vec3f(T.rotate(Vec3d(noise.axis)));
  }
  if (cloud.grid || cloud.viewpoint) cloud.viewpoint = T(cloud.viewpoint.value_or(Vec3d{}));
  cloud.frame = frame;
  return cloud;
}

}  // namespace burnish
