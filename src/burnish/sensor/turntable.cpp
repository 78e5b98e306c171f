#include "burnish/sensor/turntable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "burnish/base/random.h"
#include "burnish/io/atomic_writer.h"
#include "burnish/io/depth_image.h"
#include "burnish/io/geometry_file.h"
#include "burnish/sensor/camera_file.h"
#include "burnish/sensor/pose_list.h"
#include "burnish/sensor/staging_folder.h"
#include "burnish/sensor/virtual_camera.h"

namespace burnish {
namespace fs = std::filesystem;
namespace {

constexpr double kFrame = 1.02;  ///< the model's sphere fills the view but for 2 %
constexpr double kGap = 0.02;    ///< m between the nearest depth measured and the model's sphere
constexpr double kMillimetre = 0.001;  ///< what the numbers of a Kinect's images count

/// The sphere around the middle of the model's box that holds all vertices.
struct Sphere {
  Vec3d centre;
  double radius = 0;
  double extent = 0;  ///< largest side of the box
};

Sphere sphere_around(const TriangleMesh& mesh) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec3d low{kInfinity, kInfinity, kInfinity}, high = -low;
  for (const Vec3f& p : mesh.positions) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], double{p[axis]});
      high[axis] = std::max(high[axis], double{p[axis]});
    }
  }
  const Vec3d size = high - low;
  Sphere sphere{0.5 * (low + high), 0, std::max({size.x, size.y, size.z})};
  for (const Vec3f& p : mesh.positions) {
    sphere.radius = std::max(sphere.radius, norm(Vec3d(p) - sphere.centre));
  }
  sphere.centre += mesh.frame.origin;
  return sphere;
}

/// The model without unused vertices, scaled about the origin of its coordinates.
TriangleMesh scaled(const TriangleMesh& model, double scale) {
  TriangleMesh mesh = without_unused_vertices(model);
  if (scale == 1) return mesh;
  mesh.frame.origin *= scale;
  for (Vec3f& p : mesh.positions) p = Vec3f(scale * Vec3d(p));
  for (float& sigma : mesh.attributes.sigma) sigma = static_cast<float>(scale * sigma);
  for (PointNoise& noise : mesh.attributes.noise) {
    noise.along = static_cast<float>(scale * noise.along);
    noise.across = static_cast<float>(scale * noise.across);
  }
  return mesh;
}

/// How far the camera has to be for the sphere to be in view and not too near to be measured.
double fitting_distance(const Sphere& sphere, const Sensor& sensor) {
  const Camera& c = sensor.camera;
  const double half_view = std::min(
      {c.cx / c.fx, (c.width - 1 - c.cx) / c.fx, c.cy / c.fy, (c.height - 1 - c.cy) / c.fy});
  // A sphere seen under the half angle a is radius / sin(a) away; sin(a) = tan(a) / sqrt(1 +
  // tan(a)^2).
  const double in_view = kFrame * sphere.radius * std::sqrt(1 + half_view * half_view) / half_view;
  return std::max(in_view, sensor.noise.min_depth + sphere.radius + kGap);
}

Result<double> choose_distance(const Sphere& sphere, const Sensor& sensor, double asked) {
  const double distance = asked > 0 ? asked : fitting_distance(sphere, sensor);
  const double farthest =
      sensor.noise.max_depth > 0 ? sensor.noise.max_depth : std::numeric_limits<double>::infinity();
  // A distance that was asked for may cut the model off; one of our own shall not.
  const double slack = asked > 0 ? sphere.radius : -sphere.radius;
  if (std::isfinite(distance) && distance + slack > sensor.noise.min_depth &&
      distance - slack < farthest) {
    return distance;
  }
  return Error{ErrorCode::invalid_argument,
               fmt::format("the model, {:.3g} m large, is out of the range {} to {} m of {} at "
                           "{:.3g} m: give another size or distance",
                           sphere.extent, sensor.noise.min_depth, farthest, sensor.name, distance),
               {}};
}

/// The camera at azimuth 0.
RigidTransform first_pose(const Sphere& sphere, const TurntableParams& params, double distance,
                          int view) {
  const double rise = (std::numbers::pi / 2 - params.elevation) / params.rings;
  const double height = params.elevation + rise * (view % params.rings);
  const Vec3d outwards{std::cos(height), 0, std::sin(height)};
  return look_at(sphere.centre + distance * outwards, sphere.centre, {0, 0, 1});
}

RigidTransform rotation_about(const Vec3d& unit_axis, double angle) {
  const Vec3d v = unit_axis * std::sin(angle / 2);
  return rigid_from_quaternion(v.x, v.y, v.z, std::cos(angle / 2), {});
}

/// A turntable: its axis is the z of its own coordinates.
struct Table {
  RigidTransform T_world_table;
  std::vector<double> angles;  ///< of each view

  Table(const Sphere& sphere, const TurntableParams& params) {
    Random random(static_cast<std::uint64_t>(params.seed), 0);
    const double towards = random.uniform(0, 2 * std::numbers::pi);
    const double tilted_about = random.uniform(0, 2 * std::numbers::pi);
    T_world_table =
        rotation_about({std::cos(tilted_about), std::sin(tilted_about), 0}, params.axis_tilt);
    T_world_table.translation =
        sphere.centre + params.axis_offset * Vec3d{std::cos(towards), std::sin(towards), 0};
    for (int view = 0; view < params.views; ++view) {
      const double off = view == 0 ? 0 : params.step_jitter * random.normal();
      angles.push_back(2 * std::numbers::pi * view / params.views + off);
    }
  }

  RigidTransform seen_at(int view, const RigidTransform& T_world_camera) const {
    const RigidTransform turn = rotation_about({0, 0, 1}, angles[static_cast<std::size_t>(view)]);
    return T_world_table * turn * T_world_table.inverse() * T_world_camera;
  }
};

Result<void> write_picture(const fs::path& stem, const DepthFrame& frame, bool exact) {
  const Camera& camera = frame.camera;
  if (exact) {
    return write_depth_tiff(stem.string() + ".depth.tiff", camera.width, camera.height,
                            frame.depth);
  }
  std::vector<std::uint16_t> millimetres;
  millimetres.reserve(frame.depth.size());
  for (const float z : frame.depth) {
    // 65535 means "no depth", so what is too far to be told in 16 bits is none either.
    const double value = std::round(z / kMillimetre);
    millimetres.push_back(value < 65535 ? static_cast<std::uint16_t>(value) : 0);
  }
  return write_depth_png(stem.string() + ".depth.png", camera.width, camera.height, millimetres);
}

std::string parameters_json(const Sensor& sensor, const TurntableParams& params,
                            const Simulation& done) {
  nlohmann::ordered_json json;
  json["sensor"] = sensor.name;
  for (const auto& [key, value] : TurntableParams::schema().settings(params))
    json["params"][key] = value;
  for (const Fact& fact : done.facts()) json["result"][fact.key] = fact.value;
  return json.dump(2) + "\n";
}

/// Everything but the pictures and their poses.
Result<void> write_beside(const fs::path& folder, const TriangleMesh& world, const Sensor& sensor,
                          const TurntableParams& params, const std::string& poses,
                          const Simulation& done) {
  const CameraFile camera{sensor.camera, params.noise == 0 ? 1 : kMillimetre, sensor.name};
  const std::pair<const char*, std::string> files[] = {
      {"camera.txt", camera_file_text(camera)},
      {"camera-intrinsics.txt", intrinsics_text(sensor.camera)},
      {"truth/poses.txt", "# x y z qx qy qz qw, camera to world\n" + poses},
      {"simulation.json", parameters_json(sensor, params, done)}};
  for (const auto& [name, text] : files) {
    if (auto written = write_file(folder / name, text); !written) return written;
  }
  const auto written = write_mesh(folder / "truth" / "model.ply", world);
  if (!written) return written.error();
  return {};
}

std::string pose_line(const RigidTransform& pose) {
  const auto q = quaternion(pose);
  const Vec3d& t = pose.translation;
  return fmt::format("{} {} {} {} {} {} {}\n", t.x, t.y, t.z, q[0], q[1], q[2], q[3]);
}

}  // namespace

const Schema<TurntableParams>& TurntableParams::schema() {
  using P = TurntableParams;
  static const auto schema =
      Schema<P>()
          .integer("views", &P::views, between(1, 100000),
                   "how many pictures are taken around the model")
          .integer("seed", &P::seed, between(0, std::numeric_limits<int>::max()),
                   "another number, another noise")
          .real("size", &P::size, at_least(0), "largest extent of the model; 0 keeps its own",
                Quantity::length)
          .real("distance", &P::distance, at_least(0),
                "from the camera to the middle of the model; 0 fills the view", Quantity::length)
          .real("elevation", &P::elevation, between(-1.5, 1.5),
                "of the lowest ring of views above the horizontal", Quantity::angle)
          .integer("rings", &P::rings, between(1, 1000), "rings of views between there and the top")
          .real("noise", &P::noise, at_least(0), "share of the sensor's noise; 0 is exact")
          .real("axis_offset", &P::axis_offset, at_least(0),
                "of the table's axis from the middle of the model", Quantity::length)
          .real("axis_tilt", &P::axis_tilt, between(0, 0.5), "of the axis from the vertical",
                Quantity::angle)
          .real("step_jitter", &P::step_jitter, between(0, 0.5),
                "one standard deviation of the table's angle at every view", Quantity::angle);
  return schema;
}

Facts Simulation::facts() const {
  return {{"views", static_cast<double>(views), ""},
          {"scale", scale, ""},
          {"distance", distance, "m"},
          {"measured_pixels", static_cast<double>(measured_pixels), ""}};
}

Result<Simulation> simulate_turntable(const TriangleMesh& model, const Sensor& sensor,
                                      const TurntableParams& params, const fs::path& folder,
                                      const Context& context) {
  if (auto valid = TurntableParams::schema().check(params); !valid) return valid.error();
  if (auto sound = check(model); !sound) return sound.error();
  const double extent = sphere_around(without_unused_vertices(model)).extent;
  Simulation done{.views = params.views};
  if (params.size > 0 && extent > 0) done.scale = params.size / extent;
  const TriangleMesh world = scaled(model, done.scale);
  const auto camera = VirtualCamera::create(world, sensor, context);
  if (!camera) return camera.error();
  const Sphere sphere = sphere_around(world);
  const auto distance = choose_distance(sphere, sensor, params.distance);
  if (!distance) return distance.error();
  done.distance = *distance;

  auto staging = StagingFolder::create(folder, "simulation.json");
  if (!staging) return staging.error();
  const Table table(sphere, params);
  std::string poses;
  for (int view = 0; view < params.views; ++view) {
    const RigidTransform pose = table.seen_at(view, first_pose(sphere, params, *distance, view));
    const auto frame = camera->capture(
        pose,
        {params.noise, static_cast<std::uint64_t>(params.seed), static_cast<std::uint64_t>(view)},
        context.part(double(view) / params.views, double(view + 1) / params.views));
    if (!frame) return frame.error();
    done.measured_pixels +=
        frame->depth.size() - std::count(frame->depth.begin(), frame->depth.end(), 0.f);
    const fs::path stem = staging->path() / fmt::format("frame-{:06}", view);
    if (auto written = write_picture(stem, *frame, params.noise == 0); !written)
      return written.error();
    if (auto written = write_file(stem.string() + ".pose.txt", pose_matrix_text(pose)); !written) {
      return written.error();
    }
    poses += pose_line(pose);
  }
  if (auto written = write_beside(staging->path(), world, sensor, params, poses, done); !written) {
    return written.error();
  }
  if (context.cancelled()) return cancelled();
  if (auto moved = staging->commit(); !moved) return moved.error();
  return done;
}

}  // namespace burnish
