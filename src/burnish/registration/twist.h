#pragma once

#include "burnish/base/rigid.h"
#include "burnish/registration/pair.h"

namespace burnish {

/// The rotation by |v| rad about v (Rodrigues).
RigidTransform rotation_by(const Vec3d& v);

/// The inverse of rotation_by, |v| <= pi; the translation is not looked at.
Vec3d rotation_vector(const RigidTransform& T);

/// T moved by a twist in the axes that it maps to: turned about their origin, then shifted.
RigidTransform moved(const RigidTransform& T, const Twist& twist);

/// The twist that moves `from` to `to`: moved(from, difference(from, to)) is `to` but for rounding.
Twist difference(const RigidTransform& from, const RigidTransform& to);

/// A small motion told in the axes that T maps to instead of those that it maps from.
Twist in_axes_of(const RigidTransform& T, const Twist& twist);

}  // namespace burnish
