#pragma once

#include "burnish/base/vec3.h"

namespace burnish {

/// A weighted sum of squared distances from planes and points as a function of the place x:
/// x' A x + 2 b' x + c with A symmetric (Garland and Heckbert 1997, section 5).
struct Quadric {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;  ///< A
  Vec3d b{};
  double c = 0;

  /// weight (n' x - offset)^2; `n` need not be of unit length.
  static Quadric plane(const Vec3d& n, double offset, double weight) {
    const Vec3d w = n * weight;
    return {w.x * n.x, w.x * n.y, w.x * n.z,   w.y * n.y,
            w.y * n.z, w.z * n.z, w * -offset, weight * offset * offset};
  }
  /// weight |x - p|^2
  static Quadric point(const Vec3d& p, double weight) {
    return {weight, 0, 0, weight, 0, weight, p * -weight, weight * squared_norm(p)};
  }

  Quadric& operator+=(const Quadric& q) {
    xx += q.xx, xy += q.xy, xz += q.xz, yy += q.yy, yz += q.yz, zz += q.zz;
    b += q.b;
    c += q.c;
    return *this;
  }
  friend Quadric operator*(const Quadric& q, double s) {
    return {q.xx * s, q.xy * s, q.xz * s, q.yy * s, q.yz * s, q.zz * s, q.b * s, q.c * s};
  }
  friend Quadric operator+(Quadric a, const Quadric& q) { return a += q; }

  double operator()(const Vec3d& p) const {
    const Vec3d ap{xx * p.x + xy * p.y + xz * p.z, xy * p.x + yy * p.y + yz * p.z,
                   xz * p.x + yz * p.y + zz * p.z};
    return dot(ap + b * 2.0, p) + c;
  }

  /// A^-1 r. A must be positive definite: it is once a point has been added.
  Vec3d solve(const Vec3d& r) const {
    const double l11 = xx, l21 = xy / l11, l31 = xz / l11;
    const double d2 = yy - l21 * xy, e = yz - l21 * xz, l32 = e / d2;
    const double d3 = zz - l31 * xz - l32 * e;
    const double y1 = r.x, y2 = r.y - l21 * y1, y3 = r.z - l31 * y1 - l32 * y2;
    const double z = y3 / d3, y = y2 / d2 - l32 * z, x = y1 / l11 - l21 * y - l31 * z;
    return {x, y, z};
  }

  /// Where it is least, everywhere and on the plane n' x = offset.
  Vec3d least() const { return solve(-b); }
  Vec3d least_on(const Vec3d& n, double offset) const {
    const Vec3d free = least(), along = solve(n);
    const double rise = dot(n, along);
    return rise > 0 ? free + along * ((offset - dot(n, free)) / rise) : free;
  }
};

}  // namespace burnish
