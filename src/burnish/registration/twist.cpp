#include "burnish/registration/twist.h"

#include <cmath>

namespace burnish {

RigidTransform rotation_by(const Vec3d& v) {
  const double half = norm(v) / 2;
  const double scale = half > 1e-8 ? std::sin(half) / (2 * half) : 0.5;
  return rigid_from_quaternion(scale * v.x, scale * v.y, scale * v.z, std::cos(half), {});
}

Vec3d rotation_vector(const RigidTransform& T) {
  const auto [x, y, z, w] = quaternion(T);
  const Vec3d v{x, y, z};
  const double sine = norm(v);
  return v * (sine > 1e-8 ? 2 * std::atan2(sine, w) / sine : 2);
}

RigidTransform moved(const RigidTransform& T, const Twist& twist) {
  RigidTransform step = rotation_by(twist.rotation);
  step.translation = twist.translation;
  const RigidTransform result = step * T;
  const auto [qx, qy, qz, qw] = quaternion(result);  // rounding does not add up
  return rigid_from_quaternion(qx, qy, qz, qw, result.translation);
}

Twist difference(const RigidTransform& from, const RigidTransform& to) {
  const RigidTransform step = to * from.inverse();
  return {rotation_vector(step), step.translation};
}

Twist in_axes_of(const RigidTransform& T, const Twist& twist) {
  const Vec3d rotation = T.rotate(twist.rotation);
  return {rotation, T.rotate(twist.translation) + cross(T.translation, rotation)};
}

}  // namespace burnish
