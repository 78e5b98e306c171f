#include "burnish/base/rigid.h"

#include <cmath>

namespace burnish {
namespace {

std::array<Vec3d, 3> transposed(const std::array<Vec3d, 3>& rows) {
  return {{{rows[0].x, rows[1].x, rows[2].x},
           {rows[0].y, rows[1].y, rows[2].y},
           {rows[0].z, rows[1].z, rows[2].z}}};
}

}  // namespace

RigidTransform RigidTransform::inverse() const {
  RigidTransform result{transposed(rows), {}};
  result.translation = -result.rotate(translation);
  return result;
}

RigidTransform operator*(const RigidTransform& a, const RigidTransform& b) {
  const auto columns = transposed(b.rows);
  RigidTransform result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.rows[i] = {dot(a.rows[i], columns[0]), dot(a.rows[i], columns[1]),
                      dot(a.rows[i], columns[2])};
  }
  result.translation = a(b.translation);
  return result;
}

RigidTransform rigid_from_quaternion(double qx, double qy, double qz, double qw,
                                     const Vec3d& translation) {
  const double length = std::sqrt(qx * qx + qy * qy + qz * qz + qw * qw);
  const double x = qx / length, y = qy / length, z = qz / length, w = qw / length;
  return {{{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
            {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
            {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}}},
          translation};
}

std::array<double, 4> quaternion(const RigidTransform& transform) {
  const auto& r = transform.rows;
  // Of the four ways to read a quaternion off a rotation, take the one with the largest component:
  // it divides by no small number.
  const double trace = r[0].x + r[1].y + r[2].z;
  std::array<double, 4> q;
  if (trace >= r[0].x && trace >= r[1].y && trace >= r[2].z) {
    q = {r[2].y - r[1].z, r[0].z - r[2].x, r[1].x - r[0].y, 1 + trace};
  } else if (r[0].x >= r[1].y && r[0].x >= r[2].z) {
    q = {1 + r[0].x - r[1].y - r[2].z, r[0].y + r[1].x, r[0].z + r[2].x, r[2].y - r[1].z};
  } else if (r[1].y >= r[2].z) {
    q = {r[0].y + r[1].x, 1 + r[1].y - r[0].x - r[2].z, r[1].z + r[2].y, r[0].z - r[2].x};
  } else {
    q = {r[0].z + r[2].x, r[1].z + r[2].y, 1 + r[2].z - r[0].x - r[1].y, r[1].x - r[0].y};
  }
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  const double scale = (q[3] < 0 ? -1 : 1) / length;
  for (double& component : q) component *= scale;
  return q;
}

RigidTransform look_at(const Vec3d& eye, const Vec3d& target, const Vec3d& up) {
  const Vec3d forward = normalized(target - eye);
  Vec3d right = normalized(cross(forward, up));
  if (right == Vec3d{}) {
    right = normalized(cross(forward, std::abs(forward.x) < 0.9 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0}));
  }
  const Vec3d down = cross(forward, right);
  return {transposed({right, down, forward}), eye};
}

double rotation_defect(const RigidTransform& transform) {
  const auto& r = transform.rows;
  double worst = std::abs(dot(cross(r[0], r[1]), r[2]) - 1);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) {
      worst = std::max(worst, std::abs(dot(r[i], r[j]) - (i == j ? 1 : 0)));
    }
  }
  return worst;
}

}  // namespace burnish
