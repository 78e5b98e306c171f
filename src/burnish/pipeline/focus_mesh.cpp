#include "burnish/pipeline/focus_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "burnish/adaptation/point_removal.h"
#include "burnish/base/quantity.h"
#include "burnish/pipeline/selection.h"

namespace burnish {
namespace {

/// The record's settings: those that hold something back.
Settings settings_of(const std::string& region, const Focus& focus) {
  Settings settings{{"region", region}};
  const auto length = [](double metres) { return quantity_text(metres, Quantity::length); };
  if (focus.inside_error) settings.emplace_back("inside_error", length(*focus.inside_error));
  if (std::isfinite(focus.outside_error)) {
    settings.emplace_back("outside_error", length(focus.outside_error));
  }
  if (focus.outside_triangles > 0) {
    settings.emplace_back("outside_triangles", std::to_string(focus.outside_triangles));
  }
  return settings;
}

std::size_t triangles_outside(const TriangleMesh& mesh, const PointTest& where) {
  std::vector<std::uint8_t> inside(mesh.positions.size());
  std::transform(mesh.positions.begin(), mesh.positions.end(), inside.begin(),
                 [&](const Vec3f& p) { return where(mesh.frame.origin + Vec3d(p)); });
  return static_cast<std::size_t>(std::count_if(
      mesh.triangles.begin(), mesh.triangles.end(),
      [&](const Triangle& t) { return !inside[t[0]] && !inside[t[1]] && !inside[t[2]]; }));
}

std::size_t count_inside(const TriangleMesh& mesh, const PointTest& where) {
  return static_cast<std::size_t>(
      std::count_if(mesh.positions.begin(), mesh.positions.end(),
                    [&](const Vec3f& p) { return where(mesh.frame.origin + Vec3d(p)); }));
}

using Clock = std::chrono::steady_clock;

/// What is to be made of a mesh.
struct Task {
  const std::string& region;
  const Focus& focus;
  Clock::time_point start;
  PointTest where;
  std::size_t inside = 0;  ///< vertices in the region
};

Result<Task> make_task(const TriangleMesh& mesh, const std::string& region, const Focus& focus,
                       const Context& context) {
  const Clock::time_point start = Clock::now();
  context.stage("adapting");
  Result<PointTest> where = read_selection(region, context);
  if (!where) return std::move(where).error();
  const std::size_t inside = count_inside(mesh, *where);
  if (inside > 0) return Task{region, focus, start, *std::move(where), inside};
  return Error{ErrorCode::invalid_argument, "no vertex lies in '" + region + "'", {}};
}

Result<void> focus_along(TriangleMesh& mesh, std::span<const Removal> log, const Task& task,
                         Record& record, const Context& context) {
  const auto& [region, focus, start, where, inside_before] = task;
  Result<AdaptiveMesh> adaptive = AdaptiveMesh::make(mesh, log, context.part(0, 0.7));
  if (!adaptive) return std::move(adaptive).error();
  if (auto done = adaptive->focus(where, focus, context.part(0.7, 1)); !done) return done;

  TriangleMesh result = adaptive->mesh();
  const std::size_t outside = triangles_outside(result, where);
  const auto count = [](const char* key, std::size_t n) {
    return Fact{key, static_cast<double>(n), ""};
  };
  const std::chrono::duration<double> seconds = Clock::now() - start;
  record.steps.push_back({"adapt",
                          "region",
                          settings_of(region, focus),
                          {count("triangles_before", mesh.triangles.size()),
                           count("triangles", result.triangles.size()),
                           count("triangles_outside", outside),
                           count("vertices_inside_before", inside_before),
                           count("vertices_inside", count_inside(result, where)),
                           {"error_bound", adaptive->error(), "m"}},
                          seconds.count(),
                          {}});
  if (outside > focus.outside_triangles && focus.outside_triangles > 0 &&
      !std::isfinite(focus.outside_error)) {
    record.notes.push_back(fmt::format(
        "{} triangles outside the region are as few as it allows; around it they grow step by step",
        outside));
  }
  mesh = std::move(result);
  return {};
}

}  // namespace

Result<void> focus_mesh(TriangleMesh& mesh, const std::string& region, const Focus& focus,
                        Record& record, const Context& context) {
  TriangleMesh result = without_unused_vertices(mesh);
  const Result<Task> task = make_task(result, region, focus, context.part(0, 0.1));
  if (!task) return task.error();
  const Result<std::vector<Removal>> log = removal_log(result, 0, context.part(0.1, 0.7));
  if (!log) return log.error();
  if (auto done = focus_along(result, *log, *task, record, context.part(0.7, 1)); !done)
    return done;
  mesh = std::move(result);
  return {};
}

Result<void> focus_mesh(TriangleMesh& mesh, std::span<const Removal> log, const std::string& region,
                        const Focus& focus, Record& record, const Context& context) {
  const Result<Task> task = make_task(mesh, region, focus, context.part(0, 0.3));
  if (!task) return task.error();
  return focus_along(mesh, log, *task, record, context.part(0.3, 1));
}

}  // namespace burnish
