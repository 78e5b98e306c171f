#pragma once

#include <span>

#include "burnish/base/vec3.h"
#include "burnish/core/attributes.h"

namespace burnish {

/// Light, not its encoding: red, green and blue in proportion to energy, 0 to 1. Sums and means of
/// colours are taken here.
using Light = Vec3d;

/// From and to sRGB (IEC 61966-2-1). Values outside [0, 1] are clamped on the way back.
Light linear(const Color& color);
Color srgb(const Light& light);

inline Light mix(const Light& a, const Light& b, double share_of_b) {
  return a * (1 - share_of_b) + b * share_of_b;
}

/// The light that a matt white surface sends back whose unit normal is `normal`, seen along `ray`
/// (unit length), both in camera axes (x right, y down, z forward): a warm key light from the upper
/// left, a cool weak one from the right, the sky and a little light from the camera itself, so that
/// no side is black. The normal is taken towards the camera.
Light lighting(const Vec3d& normal, const Vec3d& ray);

/// A colour for t in [0, 1] from dark blue to pale yellow; equal steps of t look equal because
/// OKLab lightness rises in proportion to t, also without colour vision. Not finite: mid grey.
Color color_of(double t);

}  // namespace burnish
