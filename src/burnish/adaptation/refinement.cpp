#include "burnish/adaptation/refinement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "burnish/core/vertex_weights.h"

namespace burnish {
namespace {

double longest_edge(const TriangleMesh& mesh) {
  double longest = 0;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d along = Vec3d(mesh.positions[t[i]]) - Vec3d(mesh.positions[t[(i + 1) % 3]]);
      longest = std::max(longest, squared_norm(along));
    }
  }
  return std::sqrt(longest);
}

}  // namespace

Result<RefinementZone> RefinementZone::of(const TriangleMesh& mesh) {
  Result<std::vector<float>> weights = vertex_weights(mesh, kRefinement);
  if (!weights) return std::move(weights).error();
  RefinementZone zone;
  zone.weights_ = *std::move(weights);
  return zone;
}

Facts RefinementReport::facts() const {
  return {{"new_vertices", static_cast<double>(new_vertices), ""},
          {"new_triangles", static_cast<double>(new_triangles), ""},
          {"moved_vertices", static_cast<double>(moved_vertices), ""},
          {"max_move", max_move, "m"},
          {"longest_edge", longest_edge, "m"}};
}

RefinementReport report_refinement(const TriangleMesh& before, const TriangleMesh& after) {
  RefinementReport report;
  report.new_vertices = after.positions.size() - before.positions.size();
  report.new_triangles = after.triangles.size() - before.triangles.size();
  for (std::size_t v = 0; v < before.positions.size(); ++v) {
    const double move = norm(Vec3d(after.positions[v]) - Vec3d(before.positions[v]));
    report.moved_vertices += move > 0;
    report.max_move = std::max(report.max_move, move);
  }
  report.longest_edge = longest_edge(after);
  return report;
}

Result<void> check_refined_size(double vertices, double triangles) {
  constexpr double kNumbers = 4294967295;
  if (vertices < kNumbers && 3 * triangles < kNumbers) return {};
  return Error{
      ErrorCode::invalid_argument,
      fmt::format("{:.3g} triangles would come of this, more than can be numbered", triangles),
      {}};
}

Result<RefinementReport> refine_in_passes(TriangleMesh& mesh, const RefinementPasses& passes,
                                          const Context& context) {
  if (auto sound = check(mesh); !sound) return sound.error();
  auto zone = RefinementZone::of(mesh);
  if (!zone) return zone.error();
  // A pass makes at most a vertex on each of three sides of every triangle.
  const double before = static_cast<double>(mesh.triangles.size());
  const double after = before * std::pow(passes.growth, passes.count);
  const double vertices = static_cast<double>(mesh.positions.size()) + 1.5 * after;
  if (auto possible = check_refined_size(vertices, after); !possible) return possible.error();
  if (context.cancelled()) return cancelled();

  TriangleMesh refined = mesh;
  for (int i = 0; i < passes.count; ++i) {
    const double all = std::pow(passes.growth, passes.count) - 1;
    const Context share = context.part((std::pow(passes.growth, i) - 1) / all,
                                       (std::pow(passes.growth, i + 1) - 1) / all);
    if (!passes.run(refined, *zone, i, share.part(0, 0.95))) return cancelled();
    zone = RefinementZone::of(refined);
    if (context.cancelled()) return cancelled();
  }
  if (!refined.attributes.normals.empty() && refined.positions.size() > mesh.positions.size()) {
    refined.attributes.normals = vertex_normals(refined);
  }
  const RefinementReport report = report_refinement(mesh, refined);
  std::swap(mesh, refined);
  context.progress(1);
  return report;
}

}  // namespace burnish
