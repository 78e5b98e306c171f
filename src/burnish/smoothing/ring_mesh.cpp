#include "burnish/smoothing/ring_mesh.h"

#include <algorithm>
#include <string>

namespace burnish {

Adjacency smoothing_rings(const TriangleMesh& mesh, BoundaryRule boundary) {
  if (boundary == BoundaryRule::free) return one_rings(mesh);
  const Adjacency ends = edge_ends(mesh);
  std::vector<std::uint32_t> offsets{0}, items;
  offsets.reserve(ends.size() + 1);
  items.reserve(ends.items().size() / 2);
  for (std::size_t v = 0; v < ends.size(); ++v) {
    const std::size_t begin = items.size();
    std::size_t along = begin;  // the neighbours along the boundary come to stand before this
    for_each_neighbour(ends.row(v), [&](std::uint32_t w, std::size_t triangles) {
      items.push_back(w);
      if (triangles != 2) items[along++] = w;
    });
    const bool on_boundary = along > begin;
    if (on_boundary) items.resize(boundary == BoundaryRule::along_boundary ? along : begin);
    offsets.push_back(static_cast<std::uint32_t>(items.size()));
  }
  return {std::move(offsets), std::move(items)};
}

namespace {

/// Without the neighbours of vertices that are pinned.
Adjacency without_pinned(const Adjacency& rings, const std::vector<float>& follows) {
  std::vector<std::uint32_t> offsets{0}, items;
  offsets.reserve(rings.offsets().size());
  items.reserve(rings.items().size());
  for (std::size_t v = 0; v < rings.size(); ++v) {
    const auto row = rings.row(v);
    if (follows[v] > 0) items.insert(items.end(), row.begin(), row.end());
    offsets.push_back(static_cast<std::uint32_t>(items.size()));
  }
  return {std::move(offsets), std::move(items)};
}

}  // namespace

Result<RingMesh> ring_mesh(const TriangleMesh& mesh, BoundaryRule boundary) {
  if (auto sound = check(mesh); !sound) return sound.error();
  Result<std::vector<float>> follows = smoothing_weights(mesh);
  if (!follows) return follows.error();
  Adjacency rings = smoothing_rings(mesh, boundary);
  if (!follows->empty()) rings = without_pinned(rings, *follows);
  return RingMesh{std::move(rings), std::move(*follows), in_double(mesh.positions)};
}

std::vector<Vec3d> in_double(const std::vector<Vec3f>& positions) {
  std::vector<Vec3d> result(positions.size());
  std::transform(positions.begin(), positions.end(), result.begin(),
                 [](const Vec3f& p) { return Vec3d(p); });
  return result;
}

std::vector<Vec3f> in_float(const std::vector<Vec3d>& positions) {
  std::vector<Vec3f> result(positions.size());
  std::transform(positions.begin(), positions.end(), result.begin(),
                 [](const Vec3d& p) { return Vec3f(p); });
  return result;
}

std::size_t longest_row(const Adjacency& rows) {
  std::size_t longest = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) longest = std::max(longest, rows.row(i).size());
  return longest;
}

Context part_of_pass(const Context& context, int pass, int passes, const Adjacency& rings) {
  Context share =
      context.part(static_cast<double>(pass) / passes, (pass + 1.0) / static_cast<double>(passes));
  // To wake other threads for a few milliseconds of work costs more than they save.
  constexpr double kSmall = 4e6;
  if (static_cast<double>(rings.items().size()) * passes < kSmall) share.threads = 1;
  return share;
}

bool ring_steps(const Context& context, const Adjacency& rings, const std::vector<Vec3d>& values,
                std::vector<Vec3d>& steps) {
  return parallel_for(context, values.size(), [&](IndexRange range) {
    for (std::size_t v = range.begin; v < range.end; ++v) {
      const auto row = rings.row(v);
      Vec3d sum;
      for (const std::uint32_t w : row) sum += values[w];
      steps[v] = row.empty() ? Vec3d{} : sum / static_cast<double>(row.size()) - values[v];
    }
  });
}

Result<SmoothingReport> commit_positions(TriangleMesh& mesh, const std::vector<Vec3d>& positions,
                                         int iterations, const Context& context) {
  std::vector<Vec3f> moved = in_float(positions);
  for (std::size_t v = 0; v < moved.size(); ++v) {
    if (is_finite(moved[v])) continue;
    return Error{ErrorCode::invalid_argument,
                 "these settings amplify instead of smoothing: positions leave the range of float",
                 "vertex " + std::to_string(v)};
  }
  std::swap(mesh.positions, moved);
  if (!mesh.attributes.normals.empty()) mesh.attributes.normals = vertex_normals(mesh);
  context.progress(1);
  return report_moves(moved, mesh, iterations);
}

}  // namespace burnish
