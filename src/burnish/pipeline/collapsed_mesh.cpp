#include "burnish/pipeline/collapsed_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "burnish/adaptation/removal_replay.h"

namespace burnish {
namespace {

/// Makes in `mesh` what a removal does to the triangles of its star.
void note_removal(CollapsedMesh& mesh, const Removal& removal, const Star& star) {
  CollapsedMesh::Step& step = mesh.steps.emplace_back();
  const std::size_t gone = star.shape == StarShape::closed ? 2 : 1;
  const std::size_t end = star.shape == StarShape::ear ? 1 : star.triangles.size();
  for (std::size_t i = 0; i < gone; ++i) {
    step.gone[i] = star.triangles[i];
    mesh.triangle_gone[star.triangles[i]] = 1;
  }
  std::sort(step.gone.begin(), step.gone.end());  // kNone is the highest
  for (const std::uint32_t t : star.triangles.subspan(gone, end - gone)) {
    Triangle& triangle = mesh.triangles[t];
    const auto corner = std::find(triangle.begin(), triangle.end(), removal.vertex);
    *corner = removal.into;
    mesh.moved.push_back(3 * t + static_cast<std::uint32_t>(corner - triangle.begin()));
  }
  step.moved_end = static_cast<std::uint32_t>(mesh.moved.size());
  mesh.vertex_gone[removal.vertex] = 1;
}

}  // namespace

Result<CollapsedMesh> collapse(const TriangleMesh& mesh, std::span<const Removal> removals,
                               const Context& context) {
  CollapsedMesh result{mesh.triangles, {}, {}, {}, {}};
  result.vertex_gone.resize(mesh.positions.size());
  result.triangle_gone.resize(mesh.triangles.size());
  result.steps.reserve(removals.size());
  RemovalReplay replay(mesh);
  float error = 0;
  for (std::size_t i = 0; i < removals.size(); ++i) {
    if (i % 4096 == 0) {
      if (context.cancelled()) return cancelled();
      context.progress(static_cast<double>(i) / static_cast<double>(removals.size()));
    }
    const Removal& removal = removals[i];
    const auto refused = [&](const std::string& why) {
      return Error{
          ErrorCode::invalid_argument,
          fmt::format("removal {} (vertex {} into {}): {}", i, removal.vertex, removal.into, why),
          {}};
    };
    if (!std::isfinite(removal.error) || removal.error < error)
      return refused(
          fmt::format("an error of {} or more was expected, {} came", error, removal.error));
    error = removal.error;
    const Result<Star> star = replay.apply(removal);
    if (!star) return refused(star.error().message);
    note_removal(result, removal, *star);
  }
  return result;
}

}  // namespace burnish
