#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "burnish/base/random.h"
#include "burnish/core/point_cloud.h"
#include "burnish/shapes/shapes.h"

namespace burnish::test {

/// Points spread evenly over a mesh, off it by `noise` along its normals, which come with them.
inline PointCloud scan_of(const TriangleMesh& mesh, int count, double noise, std::uint64_t seed) {
  std::vector<double> areas;
  double total = 0;
  const auto corner = [&](const auto& t, std::size_t k) { return Vec3d(mesh.positions[t[k]]); };
  for (const auto& t : mesh.triangles) {
    const Vec3d a = corner(t, 0);
    areas.push_back(total += norm(cross(corner(t, 1) - a, corner(t, 2) - a)) / 2);
  }
  PointCloud cloud;
  for (int i = 0; i < count; ++i) {
    Random random(seed, static_cast<std::uint64_t>(i));
    const double place = random.uniform(0, total);
    const auto found = std::upper_bound(areas.begin(), areas.end() - 1, place);
    const auto& t = mesh.triangles[static_cast<std::size_t>(found - areas.begin())];
    const Vec3d a = corner(t, 0), b = corner(t, 1), c = corner(t, 2);
    const double s = std::sqrt(random.uniform());
    const double r = random.uniform();
    const Vec3d n = normalized(cross(b - a, c - a));
    const Vec3d p = a * (1 - s) + b * (s * (1 - r)) + c * (s * r) + n * (noise * random.normal());
    cloud.positions.push_back(Vec3f(p));
    cloud.attributes.normals.push_back(Vec3f(n));
    cloud.attributes.sigma.push_back(static_cast<float>(noise));
  }
  return cloud;
}

/// A thing about 0.3 m across that turns into itself in no way.
inline TriangleMesh figure() {
  TriangleMesh result;
  const auto add = [&](const TriangleMesh& part, const Vec3d& at) {
    const auto first = static_cast<std::uint32_t>(result.positions.size());
    for (const Vec3f& p : part.positions) result.positions.push_back(p + Vec3f(at));
    for (const auto& t : part.triangles) {
      result.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
  };
  add(make_box({0.2, 0.14, 0.08}, 6), {});
  add(make_sphere(0.06, 4), {0.06, 0.02, 0.08});
  add(make_cylinder(0.03, 0.16, 48, 6), {-0.06, -0.04, 0.1});
  return result;
}

}  // namespace burnish::test
