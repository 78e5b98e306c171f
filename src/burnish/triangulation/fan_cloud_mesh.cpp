#include "burnish/triangulation/fan_cloud_mesh.h"

#include <algorithm>

#include "burnish/points/orientation.h"
#include "burnish/triangulation/fan_cloud.h"
#include "burnish/triangulation/fan_cover.h"
#include "burnish/triangulation/point_order.h"
#include "burnish/triangulation/used_points.h"

namespace burnish {
namespace {

/// So many neighbours of a point tell it which side is out.
constexpr std::size_t kLinks = 6;

/// Normals of the fans, turned towards the viewpoint or consistently.
std::vector<Vec3f> oriented_normals(const FanCloud& fans, const std::optional<Vec3d>& viewpoint,
                                    const Context& context) {
  const auto count = static_cast<std::uint32_t>(fans.size());
  std::vector<Vec3f> normals;
  normals.reserve(count);
  for (std::uint32_t p = 0; p < count; ++p) normals.push_back(fans.fan_normal(p));
  if (viewpoint) {
    for (std::uint32_t p = 0; p < count; ++p) {
      const Vec3d sight = *viewpoint - Vec3d(fans.positions()[p]);
      if (dot(Vec3d(normals[p]), sight) < 0) normals[p] = -normals[p];
    }
    return normals;
  }
  std::vector<std::uint32_t> links(count * kLinks);
  for (std::uint32_t p = 0; p < count; ++p) {
    std::size_t n = 0;
    for (const std::uint32_t q : fans.rim(p)) {
      if (q != Fan::kGap && n < kLinks) links[p * kLinks + n++] = q;
    }
    while (n < kLinks) links[p * kLinks + n++] = p;
  }
  orient_consistently(fans.positions(), NeighbourGrid(fans.positions()),
                      NeighbourLists(kLinks, std::move(links)), normals, context);
  return normals;
}

/// Turns the triangles whose owner's fan faces the other way than its normal.
void orient(std::vector<Triangle>& triangles, const FanCloud& fans,
            const std::vector<Vec3f>& normals) {
  for (Triangle& t : triangles) {
    if (dot(fans.fan_normal(t[0]), normals[t[0]]) < 0) std::swap(t[1], t[2]);
  }
}

void count_states(const FanCloud& fans, TriangulationReport& report) {
  std::size_t isolated = 0, collinear = 0, boundary = 0;
  for (std::uint32_t p = 0; p < fans.size(); ++p) {
    isolated += fans.state(p) == FanState::isolated;
    collinear += fans.state(p) == FanState::collinear;
    boundary += fans.state(p) == FanState::open;
  }
  report.duplicate_points = report.points - fans.size();
  report.isolated_points = isolated;
  report.collinear_points = collinear;
  report.boundary_points = boundary;
}

}  // namespace

Result<Triangulation> triangulate_fan_cloud(const PointCloud& cloud, const FanCloudParams& params,
                                            const Context& context) {
  if (auto valid = FanCloudParams::schema().check(params); !valid) return valid.error();
  if (auto sound = check(cloud); !sound) return sound.error();

  context.stage("ordering points");
  const std::vector<std::uint32_t> order = order_along_curve(cloud.positions);
  const PointCloud ordered = select(cloud, order);

  context.stage("building fans");
  const auto fans = FanCloud::build(ordered.positions, ordered.attributes.normals, params,
                                    context.part(0.05, 0.7));
  if (!fans) return fans.error();

  context.stage("choosing triangles");
  std::vector<Triangle> triangles = params.drawn == FanDrawing::all
                                        ? all_fan_triangles(*fans)
                                        : covering_fan_triangles(*fans, context);
  if (context.cancelled()) return cancelled();
  context.progress(0.85);
  if (ordered.attributes.normals.empty()) {
    context.stage("orienting fans");
    orient(triangles, *fans, oriented_normals(*fans, cloud.viewpoint, context));
    if (context.cancelled()) return cancelled();
  }

  for (Triangle& t : triangles) t = {order[t[0]], order[t[1]], order[t[2]]};
  Triangulation result = mesh_of_used_points(cloud, std::move(triangles));
  for (const Triangle& t : result.mesh.triangles) {
    result.mesh.triangle_attributes.owner.push_back(t[0]);
  }
  count_states(*fans, result.report);
  context.progress(1);
  return result;
}

}  // namespace burnish
