#include "burnish/points/unproject.h"

#include <functional>
#include <limits>

#include "burnish/base/parallel.h"
#include "burnish/core/transform.h"
#include "burnish/points/organized_normals.h"
#include "burnish/points/sensor_noise.h"

namespace burnish {
namespace {

constexpr std::size_t kRowsAtOnce = 8;

/// The depths that count as measured.
struct DepthRange {
  double low, high;

  DepthRange(const DepthNoise& noise, const UnprojectParams& params)
      : low(params.min_depth > 0 ? params.min_depth : noise.min_depth),
        high(params.max_depth > 0  ? params.max_depth
             : noise.max_depth > 0 ? noise.max_depth
                                   : std::numeric_limits<double>::infinity()) {}
  bool contains(double z) const { return z > 0 && z >= low && z <= high; }
};

/// The grid as the camera itself saw it, without a detour over rounded world coordinates.
ProjectiveGrid camera_grid(const DepthFrame& frame, const DepthRange& range) {
  const Camera& camera = frame.camera;
  ProjectiveGrid grid{{camera.width, camera.height}, frame.T_world_camera, {}};
  grid.pixels.resize(frame.depth.size());
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    const double z = frame.depth[i];
    if (!range.contains(z)) continue;
    const double column = static_cast<double>(i % camera.width);
    const double row = static_cast<double>(i / camera.width);
    grid.pixels[i] = {(column - camera.cx) / camera.fx, (row - camera.cy) / camera.fy, 1 / z};
  }
  return grid;
}

}  // namespace

const Schema<UnprojectParams>& UnprojectParams::schema() {
  using P = UnprojectParams;
  static const auto schema =
      Schema<P>()
          .real("min_depth", &P::min_depth, at_least(0),
                "nearer is no measurement; 0: the sensor's", Quantity::length)
          .real("max_depth", &P::max_depth, at_least(0),
                "farther is no measurement; 0: the sensor's", Quantity::length)
          .integer("window", &P::window, between(0, 50),
                   "radius of the normals' window in pixels; 0: sized by the noise")
          .flag("normals", &P::normals, "give every point a normal and its noise");
  return schema;
}

Result<PointCloud> unproject(const DepthFrame& frame, const UnprojectParams& params,
                             const Context& context) {
  PointCloud cloud;
  const Context placing = params.normals ? context.part(0, 0.2) : context;
  if (auto placed = unproject_into(frame, params, placing, cloud); !placed) return placed.error();
  if (!params.normals) return cloud;

  const ProjectiveGrid grid = camera_grid(frame, DepthRange(frame.noise, params));
  const std::size_t count = frame.depth.size();
  const Vec3d eye = frame.T_world_camera.translation;
  // Without normals sigma is the axial deviation.
  if (!organized_normals(grid, cloud.attributes.sigma, params.window, context.part(0.2, 0.6),
                         cloud.attributes.normals)) {
    return cancelled();
  }
  cloud.attributes.noise.assign(count, {});
  const bool complete = parallel_for(context.part(0.6, 1), count, [&](IndexRange part) {
    for (std::size_t i = part.begin; i < part.end; ++i) {
      const ProjectiveGrid::Pixel& pixel = grid.pixels[i];
      if (!(pixel.w > 0)) continue;
      const double z = frame.depth[i];
      const Vec3d point = frame.T_world_camera({pixel.u * z, pixel.v * z, z});
      const MeasuredNoise measured =
          measured_noise(frame.noise, frame.camera.fx, z, point - eye, cloud.attributes.normals[i],
                         {frame.noise_share_of(i), frame.sigma_share_of(i)});
      cloud.attributes.sigma[i] = measured.sigma;
      cloud.attributes.noise[i] = measured.noise;
    }
  });
  if (!complete) return cancelled();
  return cloud;
}

Result<void> unproject_into(const DepthFrame& frame, const UnprojectParams& params,
                            const Context& context, PointCloud& cloud) {
  if (auto valid = UnprojectParams::schema().check(params); !valid) return valid.error();
  if (auto sound = check(frame); !sound) return sound.error();
  const Camera& camera = frame.camera;
  const std::size_t count = frame.depth.size();
  const Vec3d eye = frame.T_world_camera.translation;
  cloud.grid = GridSize{camera.width, camera.height};
  cloud.viewpoint = eye;
  cloud.frame = frame_near(eye);
  cloud.positions.resize(count);
  cloud.attributes.sigma.resize(count);
  cloud.attributes.observations.resize(count);
  cloud.attributes.origin.assign(count, Origin::seen);

  const DepthRange range(frame.noise, params);
  constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
  const auto place = [&](IndexRange rows) {
    for (std::size_t row = rows.begin; row < rows.end; ++row) {
      const double v = (static_cast<double>(row) - camera.cy) / camera.fy;
      for (std::size_t column = 0; column < camera.width; ++column) {
        const std::size_t i = row * camera.width + column;
        const double z = frame.depth[i];
        if (!range.contains(z)) {
          cloud.positions[i] = {kMissing, kMissing, kMissing};
          cloud.attributes.sigma[i] = 0;
          cloud.attributes.observations[i] = 0;
          continue;
        }
        const double u = (static_cast<double>(column) - camera.cx) / camera.fx;
        const Vec3d point = frame.T_world_camera({u * z, v * z, z});
        cloud.positions[i] = Vec3f(point - cloud.frame.origin);
        cloud.attributes.sigma[i] =
            static_cast<float>(frame.sigma_share_of(i) * frame.noise.axial(z, 0));
        cloud.attributes.observations[i] = frame.observations.empty() ? 1 : frame.observations[i];
      }
    }
  };
  // By reference: a function object that holds it would have to be allocated.
  return parallel_for(context, camera.height, std::ref(place), kRowsAtOnce)
             ? Result<void>()
             : Result<void>(cancelled());
}

}  // namespace burnish
