#include "burnish/pipeline/collapsed_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "burnish/pipeline/triangle_stars.h"

namespace burnish {
namespace {

class Collapser {
 public:
  explicit Collapser(const TriangleMesh& mesh) {
    result_.vertex_gone.assign(mesh.positions.size(), 0);
    result_.triangle_gone.assign(mesh.triangles.size(), 0);
    stars_.reserve(mesh.positions.size(), mesh.triangles.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) stars_.add_vertex();
    for (const Triangle& triangle : mesh.triangles) stars_.add_triangle(triangle);
  }

  /// Null, or why the removal cannot be.
  const char* remove(const Removal& removal);

  CollapsedMesh result() && {
    begin_step();
    result_.triangles.reserve(stars_.triangles());
    for (std::uint32_t t = 0; t < stars_.triangles(); ++t)
      result_.triangles.push_back(stars_.triangle(t));
    return std::move(result_);
  }

 private:
  void begin_step() {
    result_.steps.emplace_back().first_moved = static_cast<std::uint32_t>(result_.moved.size());
  }
  bool gone(std::uint32_t vertex) const {
    return vertex >= result_.vertex_gone.size() || result_.vertex_gone[vertex] != 0;
  }
  const char* find_star(const Removal& removal);

  CollapsedMesh result_;
  TriangleStars stars_;
  std::vector<std::uint32_t> moving_, going_;  ///< corners at the vertex of one removal
};

/// Sorts the corners at the vertex into those that move and those whose triangles go.
const char* Collapser::find_star(const Removal& removal) {
  moving_.clear();
  going_.clear();
  for (const std::uint32_t corner : stars_.corners_at(removal.vertex)) {
    const Triangle& triangle = stars_.triangle(corner / 3);
    const auto named = std::count(triangle.begin(), triangle.end(), removal.into);
    if (named == 0) {
      moving_.push_back(corner);
      continue;
    }
    if (named != 1 || std::count(triangle.begin(), triangle.end(), removal.vertex) != 1)
      return "a triangle at its edge names a vertex twice";
    going_.push_back(corner);
  }
  if (going_.empty()) return "no triangle has both its vertices";
  if (going_.size() > 2) return "more than two triangles have both its vertices";
  return nullptr;
}

const char* Collapser::remove(const Removal& removal) {
  if (gone(removal.vertex)) return "its vertex is not there";
  if (gone(removal.into)) return "the vertex to go into is not there";
  if (removal.vertex == removal.into) return "a vertex cannot go into itself";
  if (const char* wrong = find_star(removal)) return wrong;
  begin_step();
  for (const std::uint32_t corner : going_) {
    const std::uint32_t t = corner / 3;
    for (std::uint32_t k = 0; k < 3; ++k) stars_.take(3 * t + k);
    result_.triangle_gone[t] = 1;
  }
  for (const std::uint32_t corner : moving_) {
    stars_.take(corner);
    stars_.put(corner, removal.into);
    result_.moved.push_back(corner);
  }
  std::sort(going_.begin(), going_.end());
  for (std::size_t i = 0; i < going_.size(); ++i) result_.steps.back().gone[i] = going_[i] / 3;
  result_.vertex_gone[removal.vertex] = 1;
  return nullptr;
}

}  // namespace

Result<CollapsedMesh> collapse(const TriangleMesh& mesh, std::span<const Removal> removals,
                               const Context& context) {
  Collapser collapser(mesh);
  float error = 0;
  for (std::size_t i = 0; i < removals.size(); ++i) {
    if (i % 4096 == 0) {
      if (context.cancelled()) return cancelled();
      context.progress(static_cast<double>(i) / static_cast<double>(removals.size()));
    }
    const char* wrong = collapser.remove(removals[i]);
    if (!wrong && (!std::isfinite(removals[i].error) || removals[i].error < error))
      wrong = "its error is no number or falls";
    if (wrong) {
      return Error{ErrorCode::invalid_argument,
                   fmt::format("removal {} (vertex {} into {}): {}", i, removals[i].vertex,
                               removals[i].into, wrong),
                   {}};
    }
    error = removals[i].error;
  }
  return std::move(collapser).result();
}

}  // namespace burnish
