#include "burnish/points/sensor_noise.h"

#include <algorithm>
#include <cmath>

namespace burnish {

MeasuredNoise measured_noise(const DepthNoise& sensor, double fx, double z, const Vec3d& ray,
                             const Vec3f& normal, const AxialShares& left) {
  const Vec3d axis = normalized(ray), n(normal);
  const double cosine = squared_norm(n) > 0 ? std::min(1.0, std::abs(dot(axis, n))) : 1;
  const double theta = std::acos(cosine);
  const double axial = sensor.axial(z, theta), lateral = sensor.lateral(z, theta, fx);
  return {static_cast<float>(std::hypot(left.sigma * axial * cosine, lateral * std::sin(theta))),
          {Vec3f(axis), static_cast<float>(left.noise * axial), static_cast<float>(lateral)}};
}

}  // namespace burnish
