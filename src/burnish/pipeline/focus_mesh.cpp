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

}  // namespace

Result<void> focus_mesh(TriangleMesh& mesh, const std::string& region, const Focus& focus,
                        Record& record, const Context& context) {
  const auto start = std::chrono::steady_clock::now();
  context.stage("adapting");
  const Result<PointTest> where = read_selection(region, context.part(0, 0.1));
  if (!where) return where.error();
  TriangleMesh result = without_unused_vertices(mesh);
  const std::size_t inside_before = count_inside(result, *where);
  if (inside_before == 0) {
    return Error{ErrorCode::invalid_argument, "no vertex lies in '" + region + "'", {}};
  }
  const Result<std::vector<Removal>> log = removal_log(result, 0, context.part(0.1, 0.7));
  if (!log) return log.error();
  Result<AdaptiveMesh> adaptive =
      AdaptiveMesh::make(std::move(result), *log, context.part(0.7, 0.9));
  if (!adaptive) return std::move(adaptive).error();
  if (auto done = adaptive->focus(*where, focus, context.part(0.9, 1)); !done) return done;

  result = adaptive->mesh();
  const std::size_t outside = triangles_outside(result, *where);
  const auto count = [](const char* key, std::size_t n) {
    return Fact{key, static_cast<double>(n), ""};
  };
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  record.steps.push_back({"adapt",
                          "region",
                          settings_of(region, focus),
                          {count("triangles_before", mesh.triangles.size()),
                           count("triangles", result.triangles.size()),
                           count("triangles_outside", outside),
                           count("vertices_inside_before", inside_before),
                           count("vertices_inside", count_inside(result, *where)),
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

}  // namespace burnish
