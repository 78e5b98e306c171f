#include "burnish/report/view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "burnish/core/adjacency.h"

namespace burnish {
namespace {

constexpr double kHalfHeight = 0.25;  // 28 degrees from top to bottom: little distortion
constexpr double kMargin = 1.06;

std::vector<std::uint32_t> used_vertices(const TriangleMesh& mesh) {
  std::vector<bool> used(mesh.positions.size());
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) used[v] = true;
  }
  std::vector<std::uint32_t> result;
  for (std::uint32_t v = 0; v < used.size(); ++v) {
    if (used[v]) result.push_back(v);
  }
  return result;
}

Vec3d world(const TriangleMesh& mesh, std::uint32_t v) {
  return mesh.frame.origin + Vec3d(mesh.positions[v]);
}

/// The value that `above` of the values exceed.
double ranked(std::vector<double>& values, std::size_t above) {
  const auto at = values.end() - 1 - static_cast<std::ptrdiff_t>(above);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Where a camera must stand on one image axis to see points between its two side planes: the
/// offset along the axis and the largest z from which both fit.
struct Fit {
  double offset, z;
};

Fit fit(const std::vector<Vec3d>& points, double Vec3d::*axis, double slope) {
  std::vector<double> low(points.size()), high(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    high[i] = points[i].*axis - slope * points[i].z;
    low[i] = -(points[i].*axis) - slope * points[i].z;
  }
  const std::size_t strays = points.size() / 1000;
  const double h = ranked(high, strays), l = ranked(low, strays);
  return {(h - l) / 2, -(h + l) / (2 * slope)};
}

double median_edge_length(const TriangleMesh& mesh) {
  std::vector<double> lengths;
  lengths.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      lengths.push_back(norm(Vec3d(mesh.positions[t[k]]) - Vec3d(mesh.positions[t[(k + 1) % 3]])));
    }
  }
  return lengths.empty() ? 0 : ranked(lengths, lengths.size() / 2);
}

/// Per vertex how many edges it is from a boundary, at most `most`.
std::vector<int> rings_from_boundary(const TriangleMesh& mesh, int most) {
  const Adjacency neighbours = one_rings(mesh);
  const std::vector<bool> boundary = boundary_vertices(mesh);
  std::vector<int> rings(mesh.positions.size(), most);
  std::vector<std::uint32_t> front;
  for (std::uint32_t v = 0; v < rings.size(); ++v) {
    if (boundary[v]) rings[v] = 0, front.push_back(v);
  }
  for (int ring = 1; ring < most && !front.empty(); ++ring) {
    std::vector<std::uint32_t> next;
    for (const std::uint32_t v : front) {
      for (const std::uint32_t w : neighbours.row(v)) {
        if (rings[w] > ring) rings[w] = ring, next.push_back(w);
      }
    }
    front = std::move(next);
  }
  return rings;
}

}  // namespace

View framing_view(std::string name, const TriangleMesh& mesh, const Vec3d& forward, const Vec3d& up,
                  double aspect) {
  View view{std::move(name), look_at({}, forward, up), kHalfHeight};
  const RigidTransform to_camera = view.T_world_camera.inverse();
  const auto used = used_vertices(mesh);
  Vec3d eye{0, 0, -1};
  if (!used.empty()) {
    // Relative to one of the points: coordinates may be huge.
    const Vec3d anchor = world(mesh, used.front());
    std::vector<Vec3d> points;
    points.reserve(used.size());
    for (const std::uint32_t v : used) points.push_back(to_camera.rotate(world(mesh, v) - anchor));
    const Fit x = fit(points, &Vec3d::x, kHalfHeight * aspect / kMargin);
    const Fit y = fit(points, &Vec3d::y, kHalfHeight / kMargin);
    double nearest = points.front().z, farthest = nearest;
    for (const Vec3d& p : points)
      nearest = std::min(nearest, p.z), farthest = std::max(farthest, p.z);
    eye = {x.offset, y.offset, std::min(x.z, y.z)};
    // All points in one: there is nothing to fit, stand a little off.
    const double size = std::max({farthest - nearest, nearest - eye.z, norm(anchor) * 1e-6, 1e-9});
    if (eye.z > nearest - 1e-3 * size) eye.z = nearest - size;
    view.T_world_camera.translation = anchor + view.T_world_camera.rotate(eye);
  } else {
    view.T_world_camera.translation = mesh.frame.origin + view.T_world_camera.rotate(eye);
  }
  return view;
}

std::vector<View> standard_views(const TriangleMesh& mesh, const Vec3d& forward, const Vec3d& up,
                                 double aspect) {
  const Vec3d top = normalized(up);
  const Vec3d ahead = normalized(forward - dot(forward, top) * top);
  const Vec3d right = cross(ahead, top);
  return {
      framing_view("front", mesh, ahead - 0.12 * top, top, aspect),
      framing_view("three-quarter", mesh, 0.75 * ahead - 0.66 * right - 0.45 * top, top, aspect),
      framing_view("top", mesh, 0.25 * ahead - top, top, aspect)};
}

View close_up(const TriangleMesh& mesh, const View& wide) {
  constexpr int kEdges = 9;  // from the middle to the top
  const RigidTransform to_camera = wide.T_world_camera.inverse();
  const std::vector<int> rings = rings_from_boundary(mesh, kEdges);
  std::optional<Vec3d> target;
  int best = -1;
  for (double reach = 0.35; !target && reach < 4; reach *= 2) {
    for (const std::uint32_t v : used_vertices(mesh)) {
      const Vec3d p = to_camera(world(mesh, v));
      if (p.z <= 0 || std::hypot(p.x, p.y) > reach * wide.half_height * p.z) continue;
      if (rings[v] > best || (rings[v] == best && p.z < target->z)) target = p, best = rings[v];
    }
  }
  View view = wide;
  view.name = "close-up";
  if (!target) return view;
  const double half = kEdges * median_edge_length(mesh);
  view.half_height = std::clamp(half / target->z, 1e-6, 0.5 * wide.half_height);
  const Vec3d up = wide.T_world_camera.rotate({0, -1, 0});
  view.T_world_camera = look_at(wide.T_world_camera.translation, wide.T_world_camera(*target), up);
  return view;
}

}  // namespace burnish
