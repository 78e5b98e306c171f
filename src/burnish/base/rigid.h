#pragma once

#include <array>

#include "burnish/base/vec3.h"

namespace burnish {

/// A rotation and a translation: x -> R x + t. `T_world_camera` maps camera to world.
struct RigidTransform {
  std::array<Vec3d, 3> rows{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< the rotation, row by row
  Vec3d translation{};

  Vec3d rotate(const Vec3d& v) const { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }
  Vec3d operator()(const Vec3d& p) const { return rotate(p) + translation; }
  RigidTransform inverse() const;

  friend RigidTransform operator*(const RigidTransform& a, const RigidTransform& b);
  friend bool operator==(const RigidTransform&, const RigidTransform&) = default;
};

/// From a quaternion of any length but zero.
RigidTransform rigid_from_quaternion(double qx, double qy, double qz, double qw,
                                     const Vec3d& translation);

/// {qx, qy, qz, qw} of length 1 with qw >= 0.
std::array<double, 4> quaternion(const RigidTransform& transform);

/// The pose of a camera at `eye` that looks at `target`, `up` pointing to the top of its image
/// (camera axes: x right, y down, z forward).
RigidTransform look_at(const Vec3d& eye, const Vec3d& target, const Vec3d& up);

/// How far the rotation is from orthonormal with determinant +1: 0 for a proper rotation.
double rotation_defect(const RigidTransform& transform);

}  // namespace burnish
