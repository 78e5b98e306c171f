#include "burnish/report/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "burnish/base/parallel.h"
#include "burnish/report/shade.h"
#include "burnish/spatial/ray_caster.h"

namespace burnish {
namespace {

/// Four places in a pixel with four different rows and columns (a rotated grid).
constexpr std::array<std::array<double, 2>, 4> kSamples{
    {{-0.125, -0.375}, {0.375, -0.125}, {-0.375, 0.125}, {0.125, 0.375}}};

/// The camera of a view in the coordinates of a scene; columns and rows grow to the right and down.
struct Pinhole {
  RigidTransform T_scene_camera, T_camera_scene;
  double width, height;
  double pixel;  ///< size of a pixel at distance 1

  Vec3d ray(double column, double row) const {
    const Vec3d d{(column - (width - 1) / 2) * pixel, (row - (height - 1) / 2) * pixel, 1};
    return T_scene_camera.rotate(normalized(d));
  }
  /// Column, row and depth.
  Vec3d project(const Vec3d& p) const {
    const Vec3d c = T_camera_scene(p);
    return {c.x / (c.z * pixel) + (width - 1) / 2, c.y / (c.z * pixel) + (height - 1) / 2, c.z};
  }
};

/// Where a ray met the surface.
struct Sample {
  std::uint32_t triangle;
  std::array<double, 3> weights;  ///< of the triangle's corners; they add to 1
  Vec3d point, ray;
};

/// Of a vector in the image. Pixels neither overflow nor vanish when squared, as std::hypot fears.
double length_of(double x, double y) {
  return std::sqrt(x * x + y * y);
}

/// Distance in the image between p and the segment from a to b, pixels.
double distance_to_segment(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const double dx = b.x - a.x, dy = b.y - a.y, length = dx * dx + dy * dy;
  const double along = ((p.x - a.x) * dx + (p.y - a.y) * dy) / (length > 0 ? length : 1);
  const double t = std::clamp(along, 0.0, 1.0);
  return length_of(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

/// How much of a sample an edge of the triangle covers. Edges of triangles that are only a few
/// pixels high fade out: drawn in full they would hide the surface.
double edge_cover(const Pinhole& camera, const std::array<Vec3d, 3>& corners, const Vec3d& point) {
  std::array<Vec3d, 3> seen;
  for (std::size_t k = 0; k < 3; ++k) {
    seen[k] = camera.project(corners[k]);
    if (seen[k].z <= 0) return 0;
  }
  const Vec3d p = camera.project(point);
  double nearest = std::numeric_limits<double>::infinity(), longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d &a = seen[k], &b = seen[(k + 1) % 3];
    nearest = std::min(nearest, distance_to_segment(p, a, b));
    longest = std::max(longest, length_of(b.x - a.x, b.y - a.y));
  }
  const double twice_area = std::abs((seen[1].x - seen[0].x) * (seen[2].y - seen[0].y) -
                                     (seen[1].y - seen[0].y) * (seen[2].x - seen[0].x));
  const double height = longest > 0 ? twice_area / longest : 0;
  return 0.85 * std::clamp(1.0 - nearest, 0.0, 1.0) * std::clamp((height - 1) / 5, 0.0, 1.0);
}

}  // namespace

/// A copy of the surface, moved and scaled into the unit ball: coordinates in a file may be so
/// large or so small that single precision, in which rays are cast, would not see the surface.
struct Painter::Scene {
  const TriangleMesh& mesh;
  Vec3d centre{};  ///< world
  double radius = 1;
  TriangleMesh unit;
  std::vector<Vec3f> normals;  ///< of the vertices
  std::vector<Vec3d> faces;    ///< unit normals of the triangles
  RayCaster caster;

  Scene(const TriangleMesh& source, const Context& context)
      : mesh(source), unit(into_unit_ball()), normals(vertex_normals(unit)), caster(unit, context) {
    faces.reserve(unit.triangles.size());
    for (std::size_t t = 0; t < unit.triangles.size(); ++t)
      faces.push_back(normalized(area_vector(unit, t)));
  }

  TriangleMesh into_unit_ball() {
    TriangleMesh result;
    result.triangles = mesh.triangles;
    constexpr double kMost = std::numeric_limits<double>::max();
    Vec3d low{kMost, kMost, kMost}, high{-kMost, -kMost, -kMost};
    for (const Triangle& triangle : mesh.triangles) {
      for (const std::uint32_t v : triangle) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const double x = mesh.positions[v][axis];
          low[axis] = std::min(low[axis], x), high[axis] = std::max(high[axis], x);
        }
      }
    }
    if (mesh.triangles.empty()) low = high = {};
    const Vec3d middle = (low + high) / 2.0;
    const double extent = norm(high - low) / 2;
    if (extent > 0) radius = extent;
    centre = mesh.frame.origin + middle;
    result.positions.reserve(mesh.positions.size());
    for (const Vec3f& p : mesh.positions) {
      result.positions.push_back(Vec3f((Vec3d(p) - middle) / radius));
    }
    return result;
  }

  Pinhole pinhole(const View& view, const PictureOptions& options) const {
    Pinhole camera;
    camera.T_scene_camera = view.T_world_camera;
    camera.T_scene_camera.translation = (view.T_world_camera.translation - centre) / radius;
    camera.T_camera_scene = camera.T_scene_camera.inverse();
    camera.width = options.width, camera.height = options.height;
    camera.pixel = 2 * view.half_height / options.height;
    return camera;
  }

  /// The light that comes from a place in the image; none where there is only background.
  std::optional<Light> look(const Pinhole& camera, const PictureOptions& options, double column,
                            double row) const {
    const Vec3d ray = camera.ray(column, row);
    // Start where the ball begins: a far away eye would cost digits.
    const Vec3d eye = camera.T_scene_camera.translation;
    const double lead = std::max(0.0, -dot(eye, ray) - 1.01);
    const Vec3d start = eye + lead * ray;
    const auto hit = caster.cast(start, ray);
    if (!hit) return std::nullopt;
    const double u = std::clamp(hit->u, 0.0, 1.0), v = std::clamp(hit->v, 0.0, 1.0 - u);
    return paint(camera, options,
                 {hit->triangle, {1 - u - v, u, v}, start + hit->distance * ray, ray});
  }

  Light paint(const Pinhole& camera, const PictureOptions& options, const Sample& sample) const {
    const Vec3d& face = faces[sample.triangle];
    const bool back = dot(face, sample.ray) > 0;
    Vec3d normal = face;
    if (options.smooth_normals) {
      Vec3d sum{};
      for (std::size_t k = 0; k < 3; ++k) {
        sum += sample.weights[k] * Vec3d(normals[unit.triangles[sample.triangle][k]]);
      }
      if (squared_norm(sum) > 0) normal = normalized(sum);
    }
    const Light color = back ? linear(options.back) : surface_color(options, sample);
    Light lit =
        lighting(camera.T_camera_scene.rotate(normal), camera.T_camera_scene.rotate(sample.ray));
    // Numbers are read off colours: less shade, so that they stay what they are.
    if (!options.scalars.empty()) lit = mix(lit, {0.85, 0.85, 0.85}, 0.6);
    Light light{color.x * lit.x, color.y * lit.y, color.z * lit.z};
    if (options.edges) {
      std::array<Vec3d, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) {
        corners[k] = Vec3d(unit.positions[unit.triangles[sample.triangle][k]]);
      }
      light = mix(light, linear(options.edge), edge_cover(camera, corners, sample.point));
    }
    return light;
  }

  Light surface_color(const PictureOptions& options, const Sample& sample) const {
    const Triangle& corners = unit.triangles[sample.triangle];
    const Attributes& attributes = mesh.attributes;
    Light color = linear(options.surface);
    if (!options.scalars.empty()) {
      double value = 0;
      for (std::size_t k = 0; k < 3; ++k) value += sample.weights[k] * options.scalars[corners[k]];
      if (std::isfinite(value)) {
        color = linear(color_of((value - options.low) / (options.high - options.low)));
      }
    } else if (options.vertex_colors && !attributes.colors.empty()) {
      color = {};
      for (std::size_t k = 0; k < 3; ++k) {
        color += sample.weights[k] * linear(attributes.colors[corners[k]]);
      }
    }
    if (options.origin) {
      color = mix(color, linear(options.interpolated), 0.85 * share(sample, Origin::interpolated));
      color = mix(color, linear(options.invented), 0.85 * share(sample, Origin::invented));
    }
    return color;
  }

  /// How much of a sample has this origin: all of it where the triangle does, else what the corners
  /// say.
  double share(const Sample& sample, Origin origin) const {
    const std::vector<Origin>& triangles = mesh.triangle_attributes.origin;
    if (!triangles.empty() && triangles[sample.triangle] != Origin::seen)
      return triangles[sample.triangle] == origin ? 1 : 0;
    const std::vector<Origin>& vertices = mesh.attributes.origin;
    if (vertices.empty()) return 0;
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (vertices[unit.triangles[sample.triangle][k]] == origin) sum += sample.weights[k];
    }
    return sum;
  }
};

Painter::Painter(std::unique_ptr<Scene> scene) : scene_(std::move(scene)) {}
Painter::Painter(Painter&&) noexcept = default;
Painter& Painter::operator=(Painter&&) noexcept = default;
Painter::~Painter() = default;

Result<Painter> Painter::create(const TriangleMesh& mesh, const Context& context) {
  if (auto valid = check(mesh); !valid) return valid.error();
  Painter painter(std::make_unique<Scene>(mesh, context));
  if (context.cancelled()) return cancelled();
  return painter;
}

Result<Image> Painter::paint(const View& view, const PictureOptions& options,
                             const Context& context) const {
  constexpr std::uint32_t kLargest = 16384;
  const auto refuse = [](std::string message) {
    return Error{ErrorCode::invalid_argument, std::move(message), {}};
  };
  if (options.width < 1 || options.height < 1 || options.width > kLargest ||
      options.height > kLargest) {
    return refuse(fmt::format("a picture of {} x {} pixels; 1 to {} expected", options.width,
                              options.height, kLargest));
  }
  const std::size_t count = scene_->mesh.positions.size();
  if (!options.scalars.empty() && options.scalars.size() != count) {
    return refuse(fmt::format("{} scalars for {} vertices", options.scalars.size(), count));
  }
  if (!(options.low < options.high)) return refuse("the scale of the scalars has no extent");
  if (!(view.half_height > 0) || !std::isfinite(view.half_height) ||
      !is_finite(view.T_world_camera.translation)) {
    return refuse(fmt::format("view '{}' has no opening or no place", view.name));
  }

  const Pinhole camera = scene_->pinhole(view, options);
  Image image(options.width, options.height, options.background);
  const Light background = linear(options.background);
  const bool complete = parallel_for(
      context, options.height,
      [&](IndexRange rows) {
        for (std::size_t row = rows.begin; row < rows.end; ++row) {
          for (std::uint32_t column = 0; column < options.width; ++column) {
            Light sum{};
            bool surface = false;
            for (const auto& [dx, dy] : kSamples) {
              const auto light =
                  scene_->look(camera, options, column + dx, static_cast<double>(row) + dy);
              sum += light.value_or(background);
              surface = surface || light;
            }
            if (surface) image.at(column, static_cast<std::uint32_t>(row)) = srgb(sum / 4.0);
          }
        }
      },
      4);
  if (!complete) return cancelled();
  return image;
}

Result<Image> render(const TriangleMesh& mesh, const View& view, const PictureOptions& options,
                     const Context& context) {
  const auto painter = Painter::create(mesh, context);
  if (!painter) return painter.error();
  return painter->paint(view, options, context);
}

}  // namespace burnish
