#include "burnish/sensor/virtual_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "burnish/base/parallel.h"

namespace burnish {
namespace {

constexpr std::size_t kRowsAtOnce = 4;
/// A point is in the shade where something lies so much nearer to the projector, relatively: more
/// than single precision errs, less than anything that casts a shadow worth seeing.
constexpr double kShadeTolerance = 1e-4;

std::vector<Vec3f> unit_normals(const TriangleMesh& mesh) {
  std::vector<Vec3f> normals(mesh.triangles.size());
  for (std::size_t t = 0; t < normals.size(); ++t) {
    normals[t] = Vec3f(normalized(area_vector(mesh, t)));
  }
  return normals;
}

}  // namespace

Result<VirtualCamera> VirtualCamera::create(const TriangleMesh& mesh, const Sensor& sensor,
                                            const Context& context) {
  if (auto sound = check(mesh); !sound) return sound.error();
  if (mesh.triangles.empty()) {
    return Error{ErrorCode::bad_geometry, "the mesh has no triangles to look at", {}};
  }
  if (auto sound = check(sensor.camera); !sound) return sound.error();
  VirtualCamera camera(mesh, sensor, context);
  if (context.cancelled()) return cancelled();
  return camera;
}

VirtualCamera::VirtualCamera(const TriangleMesh& mesh, const Sensor& sensor, const Context& context)
    : sensor_(sensor),
      origin_(mesh.frame.origin),
      normals_(unit_normals(mesh)),
      caster_(mesh, context) {}

Sight VirtualCamera::look(const RigidTransform& pose, std::uint32_t column,
                          std::uint32_t row) const {
  const Vec3d towards = sensor_.camera.unproject(column, row, 1);
  const double length = norm(towards);
  const Vec3d eye = pose.translation - origin_;
  const Vec3d ray = pose.rotate(towards / length);
  const auto hit = caster_.cast(eye, ray);
  if (!hit) return {};
  const double cosine = std::abs(dot(Vec3d(normals_[hit->triangle]), ray));
  Sight sight{hit->distance / length, static_cast<float>(std::acos(std::min(1.0, cosine))), true};
  if (sensor_.projector != 0) {
    const Vec3d lamp = pose({sensor_.projector, 0, 0}) - origin_;
    const Vec3d beam = eye + hit->distance * ray - lamp;
    const double reach = norm(beam);
    const auto shade = caster_.cast(lamp, beam / reach);
    sight.lit = !shade || shade->distance > reach * (1 - kShadeTolerance);
  }
  return sight;
}

Result<DepthFrame> VirtualCamera::capture(const RigidTransform& T_world_camera,
                                          const CaptureParams& params,
                                          const Context& context) const {
  if (!(params.noise >= 0 && std::isfinite(params.noise))) {
    return Error{ErrorCode::invalid_argument,
                 fmt::format("noise is {}, at least 0 is allowed", params.noise),
                 {}};
  }
  const Camera& camera = sensor_.camera;
  DepthFrame frame{camera, {}, T_world_camera, sensor_.noise, 0};
  frame.depth.resize(std::size_t{camera.width} * camera.height);
  if (auto sound = check(frame); !sound)
    return Error{ErrorCode::invalid_argument, sound.error().message, {}};

  std::vector<Sight> sights(frame.depth.size());
  const bool seen = parallel_for(
      context.part(0, 0.7), camera.height,
      [&](IndexRange rows) {
        for (std::size_t row = rows.begin; row < rows.end; ++row) {
          for (std::uint32_t column = 0; column < camera.width; ++column) {
            sights[row * camera.width + column] =
                look(T_world_camera, column, static_cast<std::uint32_t>(row));
          }
        }
      },
      kRowsAtOnce);
  if (!seen) return cancelled();
  auto depth = disturb(sensor_, sights, params, context.part(0.7, 1));
  if (!depth) return cancelled();
  frame.depth = std::move(*depth);
  return frame;
}

}  // namespace burnish
