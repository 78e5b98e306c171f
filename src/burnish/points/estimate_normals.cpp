#include "burnish/points/estimate_normals.h"

#include "burnish/points/organized_normals.h"
#include "burnish/points/surface_normals.h"
#include "burnish/spatial/neighbour_grid.h"

namespace burnish {
namespace {

struct Estimate {
  std::vector<Vec3f> normals;
  std::size_t components = 0;
};

Result<Estimate> unorganized(const PointCloud& cloud, const NormalParams& params,
                             const Context& context) {
  const NeighbourGrid grid(cloud.positions);
  NeighbourLists neighbours;
  Estimate estimate;
  std::optional<Vec3d> viewpoint;
  if (cloud.viewpoint) viewpoint = viewpoint_or_origin(cloud);
  if (!grid.nearest_of_all(static_cast<std::size_t>(params.neighbours), context.part(0, 0.5),
                           neighbours) ||
      !normals_of_surface(cloud.positions, grid, neighbours, viewpoint, context.part(0.5, 1),
                          estimate.normals, estimate.components)) {
    return cancelled();
  }
  return estimate;
}

Result<Estimate> organized(const PointCloud& cloud, const NormalParams& params,
                           const Context& context) {
  const ProjectiveGrid grid = project_grid(cloud);
  const std::vector<float> noise = depth_noise(grid, cloud.attributes.sigma);
  Estimate estimate;
  if (!organized_normals(grid, noise, params.window, context, estimate.normals)) return cancelled();
  return estimate;
}

}  // namespace

const Schema<NormalParams>& NormalParams::schema() {
  using P = NormalParams;
  static const auto schema =
      Schema<P>()
          .integer("neighbours", &P::neighbours, between(3, 1000),
                   "points of an unorganized cloud that a normal is fitted to")
          .integer("window", &P::window, between(0, 50),
                   "radius in the grid of an organized cloud, pixels; 0: sized by the noise");
  return schema;
}

Result<NormalReport> estimate_normals(PointCloud& cloud, const NormalParams& params,
                                      const Context& context) {
  if (auto valid = NormalParams::schema().check(params); !valid) return valid.error();
  if (auto sound = check(cloud); !sound) return sound.error();
  auto estimate =
      cloud.grid ? organized(cloud, params, context) : unorganized(cloud, params, context);
  if (!estimate) return estimate.error();
  NormalReport report;
  report.components = estimate->components;
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    if (!is_finite(cloud.positions[i])) continue;
    ++report.points;
    report.unknown += estimate->normals[i] == Vec3f{};
  }
  cloud.attributes.normals = std::move(estimate->normals);
  return report;
}

}  // namespace burnish
