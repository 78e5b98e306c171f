#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "burnish/core/triangle_mesh.h"
#include "burnish/triangulation/fan_cloud.h"

namespace burnish::test {

/// The corners in rising order: the triangle whichever way it faces and whoever owns it.
inline Triangle unordered(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

/// Angles at the centre of a fan, one a triangle, counter-clockwise around its normal, -pi to pi;
/// computed with arc tangents in a frame of the test's own.
inline std::vector<double> fan_angles(const FanCloud& cloud, std::uint32_t p) {
  const Vec3d n(cloud.fan_normal(p)), centre(cloud.positions()[p]);
  const Vec3d aside = std::abs(n.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  const Vec3d u = normalized(cross(aside, n)), v = cross(n, u);
  const auto polar = [&](std::uint32_t q) {
    const Vec3d to = Vec3d(cloud.positions()[q]) - centre;
    return std::atan2(dot(v, to), dot(u, to));
  };
  std::vector<double> angles;
  const auto rim = cloud.rim(p);
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const std::uint32_t q = rim[i], r = rim[i + 1 < rim.size() ? i + 1 : 0];
    if (q == Fan::kGap || r == Fan::kGap) continue;
    angles.push_back(std::remainder(polar(r) - polar(q), 2 * std::numbers::pi));
  }
  return angles;
}

/// How many fans hold each triangle.
inline std::map<Triangle, int> fan_votes(const FanCloud& cloud) {
  std::map<Triangle, int> votes;
  for (std::uint32_t p = 0; p < cloud.size(); ++p) {
    const auto rim = cloud.rim(p);
    for (std::size_t i = 0; i < rim.size(); ++i) {
      const std::uint32_t q = rim[i], r = rim[i + 1 < rim.size() ? i + 1 : 0];
      if (q != Fan::kGap && r != Fan::kGap) ++votes[unordered({p, q, r})];
    }
  }
  return votes;
}

/// The cloud built anew from its active points.
inline FanCloud built(const FanCloud& cloud) {
  std::vector<std::uint8_t> active;
  for (std::uint32_t p = 0; p < cloud.size(); ++p) active.push_back(cloud.active(p));
  return FanCloud::build(cloud.positions(), cloud.normals(), cloud.params(), {}, active).value();
}

/// Bit for bit.
inline bool same_fan(const FanCloud& a, const FanCloud& b, std::uint32_t p) {
  const auto in_use = [](FanState s) { return s == FanState::removed ? FanState::inactive : s; };
  return in_use(a.state(p)) == in_use(b.state(p)) && a.fan_normal(p) == b.fan_normal(p) &&
         std::equal(a.rim(p).begin(), a.rim(p).end(), b.rim(p).begin(), b.rim(p).end());
}

inline std::size_t differing_fans(const FanCloud& a, const FanCloud& b) {
  std::size_t count = 0;
  for (std::uint32_t p = 0; p < a.size(); ++p) count += !same_fan(a, b, p);
  return count;
}

/// From those of the cloud built anew.
inline std::size_t differing_fans(const FanCloud& edited) {
  return differing_fans(edited, built(edited));
}

}  // namespace burnish::test
