#include "burnish/points/estimate_normals.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "burnish/base/parallel.h"
#include "burnish/points/organized_normals.h"
#include "burnish/points/orientation.h"
#include "burnish/spatial/neighbour_grid.h"

namespace burnish {
namespace {

/// The direction in which the points vary least; 0 where they span no plane.
Vec3d least_direction(std::span<const Vec3f> positions, std::span<const Neighbour> points) {
  if (points.size() < 3) return {};
  const double n = static_cast<double>(points.size());
  const Vec3d first(positions[points.front().index]);
  Vec3d mean;
  for (const Neighbour& point : points) mean += Vec3d(positions[point.index]) - first;
  mean = mean / n;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Neighbour& point : points) {
    const Vec3d d = Vec3d(positions[point.index]) - first - mean;
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c <= r; ++c) {
        covariance(r, c) += d[static_cast<std::size_t>(r)] * d[static_cast<std::size_t>(c)];
      }
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  const Eigen::Vector3d variance = solver.eigenvalues(), v = solver.eigenvectors().col(0);
  if (!(variance(1) > 1e-6 * variance(2))) return {};  // a line, or all in one place
  return {v(0), v(1), v(2)};
}

struct Estimate {
  std::vector<Vec3f> normals;
  std::size_t components = 0;
};

Result<Estimate> unorganized(const PointCloud& cloud, const NormalParams& params,
                             const Context& context) {
  const NeighbourGrid grid(cloud.positions);
  const std::size_t count = cloud.positions.size();
  const std::size_t k = static_cast<std::size_t>(params.neighbours);
  Estimate estimate;
  estimate.normals.resize(count);
  std::vector<std::uint32_t> neighbours(cloud.viewpoint ? 0 : count * k);
  const bool complete = parallel_for(context.part(0, 0.8), count, [&](IndexRange range) {
    std::vector<Neighbour> found;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      grid.nearest(cloud.positions[i], k, found);
      Vec3d normal = least_direction(cloud.positions, found);
      if (cloud.viewpoint &&
          dot(normal, viewpoint_or_origin(cloud) - Vec3d(cloud.positions[i])) < 0) {
        normal = -normal;
      }
      estimate.normals[i] = Vec3f(normal);
      if (cloud.viewpoint) continue;
      for (std::size_t n = 0; n < k; ++n) {
        neighbours[i * k + n] = n < found.size() ? found[n].index : static_cast<std::uint32_t>(i);
      }
    }
  });
  if (!complete) return cancelled();
  if (!cloud.viewpoint) {
    estimate.components =
        orient_consistently(cloud.positions, neighbours, k, estimate.normals, context);
  }
  if (context.cancelled()) return cancelled();
  context.progress(1);
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
