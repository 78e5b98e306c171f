#include "burnish/report/plates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "burnish/report/numbers.h"
#include "burnish/report/picture.h"

namespace burnish {
namespace {

/// What is painted on the surface.
enum class Paint { surface, edges, sigma, deviation };

struct Shot {
  View view;
  std::string caption;
  Paint paint = Paint::surface;
};

const std::vector<float>& numbers(const Phase& phase, Paint paint) {
  return paint == Paint::sigma ? phase.mesh.attributes.sigma : phase.deviation;
}

std::vector<std::size_t> chosen_phases(std::size_t count, int most) {
  std::vector<std::size_t> chosen;
  const std::size_t limit = std::min(count, static_cast<std::size_t>(std::max(1, most)));
  for (std::size_t i = 0; i < limit; ++i) {
    // With room for one, the result is the one to see.
    chosen.push_back(limit == 1 ? count - 1 : (i * (count - 1) + (limit - 1) / 2) / (limit - 1));
  }
  return chosen;
}

/// The phase that the views frame: the last one with a surface.
const TriangleMesh& framed_mesh(const Record& record) {
  for (std::size_t i = record.phases.size(); i-- > 0;) {
    if (!record.phases[i].mesh.triangles.empty()) return record.phases[i].mesh;
  }
  return record.phases.back().mesh;
}

/// Of the six directions along the axes the one nearest to `direction`.
Vec3d nearest_axis(const Vec3d& direction) {
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (std::abs(direction[i]) > std::abs(direction[axis])) axis = i;
  }
  Vec3d result{};
  result[axis] = direction[axis] < 0 ? -1 : 1;
  return result;
}

/// Whether `eye` is within the box around the surface: a scene seen from inside, not an object.
bool inside(const TriangleMesh& mesh, const Vec3d& eye) {
  if (mesh.triangles.empty()) return false;
  const Vec3d p = eye - mesh.frame.origin;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    bool below = false, above = false;
    for (const Triangle& triangle : mesh.triangles) {
      const double x = mesh.positions[triangle[0]][axis];
      below = below || x <= p[axis];
      above = above || x >= p[axis];
    }
    if (!below || !above) return false;
  }
  return true;
}

/// The depth of the middle one of the vertices that the view sees; 1 m where it sees none.
double median_depth(const TriangleMesh& mesh, const View& view, double aspect) {
  const RigidTransform to_camera = view.T_world_camera.inverse();
  std::vector<double> depths;
  for (const Vec3f& position : mesh.positions) {
    const Vec3d p = to_camera(mesh.frame.origin + Vec3d(position));
    const double reach = view.half_height * p.z;
    if (p.z > 0 && std::abs(p.y) < reach && std::abs(p.x) < reach * aspect) depths.push_back(p.z);
  }
  if (depths.empty()) return 1;
  const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  return *middle;
}

/// From the camera itself, and from places to its side and above it that look at the same spot.
std::vector<Shot> views_of_scene(const TriangleMesh& mesh, const Viewpoint& viewpoint,
                                 const Vec3d& up, double aspect) {
  const Camera& camera = viewpoint.camera;
  View from_camera{"camera", viewpoint.T_world_camera, camera.height / (2 * camera.fy)};
  const Vec3d eye = from_camera.T_world_camera.translation;
  const double depth = median_depth(mesh, from_camera, aspect);
  const Vec3d target = from_camera.T_world_camera({0, 0, depth});
  const Vec3d right = from_camera.T_world_camera.rotate({1, 0, 0});
  const auto beside = [&](std::string name, const Vec3d& step) {
    const Vec3d place = target + depth * normalized(eye - target + depth * step);
    return View{std::move(name), look_at(place, target, up), from_camera.half_height};
  };
  return {{from_camera, "where the first frame was taken"},
          {beside("side", 0.45 * right), "from the right of the first camera"},
          {beside("above", 0.6 * up), "from above the first camera"}};
}

std::vector<Shot> surface_shots(const Record& record, const ReportOptions& options, double aspect) {
  const TriangleMesh& mesh = framed_mesh(record);
  Vec3d up = options.up.value_or(Vec3d{0, 0, 1}), forward{0, 1, 0};
  if (record.viewpoint) {
    const RigidTransform& pose = record.viewpoint->T_world_camera;
    if (!options.up) up = nearest_axis(pose.rotate({0, -1, 0}));
    forward = pose.rotate({0, 0, 1});
    if (record.viewpoint->camera.fy > 0 && inside(mesh, pose.translation)) {
      return views_of_scene(mesh, *record.viewpoint, up, aspect);
    }
  }
  if (norm(cross(forward, up)) < 0.1 * norm(up)) forward = {up.y, up.z, up.x};
  std::vector<Shot> shots;
  const char* captions[] = {"", "from the right, a little above", ""};
  const auto views = standard_views(mesh, forward, up, aspect);
  for (std::size_t i = 0; i < views.size(); ++i) shots.push_back({views[i], captions[i]});
  return shots;
}

std::vector<Shot> shots_of(const Record& record, const ReportOptions& options) {
  const double aspect = static_cast<double>(options.picture_width) / options.picture_height;
  std::vector<Shot> shots = surface_shots(record, options, aspect);
  const View main = shots[shots.size() > 1 ? 1 : 0].view;
  shots.push_back(
      {close_up(framed_mesh(record), main), "with the edges of the triangles", Paint::edges});
  const auto any = [&](Paint paint) {
    return std::any_of(record.phases.begin(), record.phases.end(),
                       [&](const Phase& phase) { return !numbers(phase, paint).empty(); });
  };
  for (const Paint paint : {Paint::deviation, Paint::sigma}) {
    if (!any(paint)) continue;
    Shot shot{main,
              paint == Paint::sigma ? "painted by one standard deviation of each vertex"
                                    : "painted by the distance to the true surface",
              paint};
    shot.view.name = paint == Paint::sigma ? "sigma" : "deviation";
    shots.push_back(std::move(shot));
  }
  return shots;
}

/// From 0 to what 19 of 20 vertices of every phase do not exceed.
ColorScale scale_of(const Record& record, Paint paint) {
  ColorScale scale{
      paint == Paint::sigma ? "Standard deviation of the position" : "Distance to the true surface",
      0, 0, "m"};
  for (const Phase& phase : record.phases) {
    std::vector<float> sizes;
    for (const float value : numbers(phase, paint)) {
      if (std::isfinite(value)) sizes.push_back(std::abs(value));
    }
    if (sizes.empty()) continue;
    const auto high = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() * 19 / 20);
    std::nth_element(sizes.begin(), high, sizes.end());
    scale.high = std::max(scale.high, static_cast<double>(*high));
  }
  if (scale.high <= 0) scale.high = 1e-3;
  return scale;
}

Result<Image> paint_shot(const Painter& painter, const Phase& phase, const Shot& shot,
                         const Plate& plate, const ReportOptions& options, const Context& context) {
  PictureOptions picture{.width = options.picture_width, .height = options.picture_height};
  picture.edges = shot.paint == Paint::edges;
  std::vector<float> sizes;
  if (plate.scale) {
    const std::vector<float>& values = numbers(phase, shot.paint);
    if (values.empty()) return Image{};
    for (const float value : values) sizes.push_back(std::abs(value));
    picture.scalars = sizes;
    picture.low = plate.scale->low, picture.high = plate.scale->high;
    picture.origin = false;
  }
  return painter.paint(shot.view, picture, context);
}

}  // namespace

std::string limit_text(const ColorScale& scale, double value) {
  return value == 0 ? "0" : quantity_text(value, scale.unit);
}

Result<Plates> paint_plates(const Record& record, const ReportOptions& options,
                            const Context& context) {
  Plates result;
  if (record.phases.empty()) return result;
  if (options.picture_width == 0 || options.picture_height == 0) {
    return Error{ErrorCode::invalid_argument, "a picture without pixels", {}};
  }
  for (const Phase& phase : record.phases) {
    if (auto valid = check(phase.mesh); !valid) {
      return Error{valid.error().code, valid.error().message, phase.name};
    }
  }
  result.phases = chosen_phases(record.phases.size(), options.pictured_phases);
  const std::vector<Shot> shots = shots_of(record, options);
  if (context.cancelled()) return cancelled();
  for (const Shot& shot : shots) {
    Plate plate{shot.view.name, shot.caption, std::nullopt, {}};
    if (shot.paint == Paint::sigma || shot.paint == Paint::deviation) {
      plate.scale = scale_of(record, shot.paint);
    }
    result.plates.push_back(std::move(plate));
  }
  const double total = static_cast<double>(result.phases.size() * shots.size());
  double done = 0;
  for (const std::size_t index : result.phases) {
    const Phase& phase = record.phases[index];
    const auto painter = Painter::create(phase.mesh, context);
    if (!painter) return Error{painter.error().code, painter.error().message, phase.name};
    for (std::size_t i = 0; i < shots.size(); ++i, ++done) {
      auto image = paint_shot(*painter, phase, shots[i], result.plates[i], options,
                              context.part(done / total, (done + 1) / total));
      if (!image) return Error{image.error().code, image.error().message, phase.name};
      result.plates[i].pictures.push_back(std::move(*image));
    }
  }
  return result;
}

}  // namespace burnish
