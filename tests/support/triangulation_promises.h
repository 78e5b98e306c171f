#pragma once

#include <cstdio>
#include <cstdlib>
#include <span>

#include "burnish/core/topology.h"
#include "burnish/triangulation/delaunay.h"
#include "burnish/triangulation/fan_cloud.h"
#include "burnish/triangulation/fan_cloud_mesh.h"
#include "burnish/triangulation/global.h"

namespace burnish::test {

/// Points of a lattice of 1000^3, three 16-bit numbers each, so that degeneracy is the norm. The
/// first byte says along how many axes they are spread (0: one place, 1: a line, 2: a plane), and
/// whether they have normals.
inline PointCloud lattice_cloud(std::span<const std::uint8_t> bytes) {
  PointCloud cloud;
  if (bytes.empty()) return cloud;
  const std::size_t axes = bytes[0] % 4;
  const bool oriented = bytes[0] & 4, small = bytes[0] & 8;
  const auto number = [&](std::size_t at) { return bytes[at] | bytes[at + 1] << 8; };
  for (std::size_t at = 1; at + 6 <= bytes.size(); at += 6) {
    Vec3f p, normal;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int value = number(at + 2 * axis);
      if (axis < axes) p[axis] = static_cast<float>(value % (small ? 10 : 1000));
      normal[axis] = static_cast<float>(value / 1000 - 32);
    }
    cloud.positions.push_back(p);
    if (oriented) cloud.attributes.normals.push_back(normalized(normal));
  }
  return cloud;
}

inline void require_promise(bool kept, const char* method, const char* what) {
  if (kept) return;
  std::fprintf(stderr, "%s: broken promise: %s\n", method, what);
  std::abort();
}

/// What every triangulation promises, whatever the points are. Ends the process where it is broken,
/// as fuzzers want it.
inline void expect_triangulations_keep_promises(const PointCloud& cloud) {
  const auto surface = [&](const Result<Triangulation>& result, const char* method, bool manifold) {
    require_promise(result.has_value(), method, "any finite points are taken");
    require_promise(check(result->mesh).has_value(), method, "the mesh is sound");
    const Topology t = topology(result->mesh);
    require_promise(t.degenerate_triangles == 0, method, "no triangle names a point twice");
    require_promise(result->report.points == cloud.positions.size(), method, "all are counted");
    require_promise(
        result->report.unused_points + result->mesh.positions.size() == result->report.points,
        method, "a point is used or counted as unused");
    if (!manifold) return;
    require_promise(t.oriented(), method, "one orientation, two triangles an edge at most");
    require_promise(t.duplicate_triangles == 0, method, "no triangle twice");
  };
  const auto global = [&](Agreement agreement) {
    const auto result = triangulate_global(cloud, {.agreement = agreement});
    surface(result, "global", true);
    require_promise(topology(result->mesh).non_manifold_vertices == 0, "global",
                    "one fan a vertex");
  };
  global(Agreement::vote);
  global(Agreement::front);
  surface(triangulate_delaunay(cloud, {.projection = Projection::z}), "delaunay", true);
  surface(triangulate_delaunay(cloud), "delaunay", true);
  for (const FanVariant variant : {FanVariant::ring, FanVariant::delaunay}) {
    surface(triangulate_fan_cloud(cloud, {.variant = variant}), "fan_cloud", false);
  }
}

/// Removes and adds points, and asks for what building anew gives.
inline void expect_edits_equal_rebuild(const PointCloud& cloud) {
  auto edited = FanCloud::build(cloud.positions, cloud.attributes.normals);
  require_promise(edited.has_value(), "FanCloud", "any finite points are taken");
  std::vector<std::uint8_t> active(cloud.positions.size(), 1);
  for (std::uint32_t p = 0; p < active.size(); p += 2) {
    active[p] = 0;
    require_promise(edited->set_active(p, false).has_value(), "FanCloud", "a point may rest");
  }
  const auto built = FanCloud::build(cloud.positions, cloud.attributes.normals, {}, {}, active);
  for (std::uint32_t p = 0; p < active.size(); ++p) {
    const auto a = edited->rim(p), b = built->rim(p);
    require_promise(
        edited->state(p) == built->state(p) && std::equal(a.begin(), a.end(), b.begin(), b.end()),
        "FanCloud", "an edited cloud is what building anew gives");
  }
}

}  // namespace burnish::test
