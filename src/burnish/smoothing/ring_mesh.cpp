#include "burnish/smoothing/ring_mesh.h"

#include <algorithm>
#include <string>

namespace burnish {

Adjacency smoothing_rings(const TriangleMesh& mesh, BoundaryRule boundary) {
  switch (boundary) {
    case BoundaryRule::fixed:
      return one_rings(mesh, BoundaryRings::none);
    case BoundaryRule::along_boundary:
      return one_rings(mesh, BoundaryRings::along_boundary);
    case BoundaryRule::free:
      break;
  }
  return one_rings(mesh, BoundaryRings::all);
}

namespace {

/// Without the neighbours of vertices that are pinned.
Adjacency without_pinned(const Adjacency& rings, const std::vector<float>& follows) {
  LargeVector<std::uint32_t> offsets{0}, items;
  offsets.reserve(rings.offsets().size());
  items.reserve(rings.items().size());
  for (std::size_t v = 0; v < rings.size(); ++v) {
    const auto row = rings.row(v);
    if (follows[v] > 0) items.insert(items.end(), row.begin(), row.end());
    offsets.push_back(static_cast<std::uint32_t>(items.size()));
  }
  return {std::move(offsets), std::move(items)};
}

Result<MovableRings> movable_rings(const TriangleMesh& mesh, BoundaryRule boundary) {
  if (auto sound = check(mesh); !sound) return sound.error();
  Result<std::vector<float>> follows = smoothing_weights(mesh);
  if (!follows) return follows.error();
  Adjacency rings = smoothing_rings(mesh, boundary);
  if (!follows->empty()) rings = without_pinned(rings, *follows);
  return MovableRings{std::move(rings), std::move(*follows)};
}

/// Puts positions in float into the mesh.
Result<SmoothingReport> commit(TriangleMesh& mesh, std::vector<Vec3f> moved, int iterations,
                               const Context& context) {
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

}  // namespace

Result<RingMesh> ring_mesh(const TriangleMesh& mesh, BoundaryRule boundary) {
  Result<MovableRings> rings = movable_rings(mesh, boundary);
  if (!rings) return rings.error();
  RingMesh work{*std::move(rings), std::vector<Vec3d>(mesh.positions.size())};
  std::transform(mesh.positions.begin(), mesh.positions.end(), work.positions.begin(),
                 [](const Vec3f& p) { return Vec3d(p); });
  return work;
}

Result<SweptMesh> swept_mesh(const TriangleMesh& mesh, BoundaryRule boundary, int passes,
                             const Context& context, const SweepLayout& layout) {
  Result<MovableRings> rings = movable_rings(mesh, boundary);
  if (!rings) return rings.error();
  SweptMesh work;
  RingSweep& sweep = work.sweep;
  if (!sweep.lay_out(context, std::move(rings->rings), passes, layout)) return cancelled();
  work.follows = sweep.taken_over(rings->follows);
  work.positions.resize(sweep.size());
  for (std::size_t v = 0; v < sweep.size(); ++v) {
    work.positions[v] = Vec3d(mesh.positions[sweep.in_mesh(v)]);
  }
  return work;
}

Context part_of_pass(const Context& context, int pass, int passes, const Adjacency& rings) {
  Context share =
      context.part(static_cast<double>(pass) / passes, (pass + 1.0) / static_cast<double>(passes));
  if (is_little_work(rings.items().size(), passes)) share.threads = 1;
  return share;
}

Result<SmoothingReport> commit_positions(TriangleMesh& mesh, const std::vector<Vec3d>& positions,
                                         int iterations, const Context& context) {
  std::vector<Vec3f> moved(positions.size());
  std::transform(positions.begin(), positions.end(), moved.begin(),
                 [](const Vec3d& p) { return Vec3f(p); });
  return commit(mesh, std::move(moved), iterations, context);
}

Result<SmoothingReport> commit_positions(TriangleMesh& mesh, const RingSweep& sweep,
                                         const LargeVector<Vec3d>& positions, int iterations,
                                         const Context& context) {
  std::vector<Vec3f> moved(positions.size());
  for (std::size_t v = 0; v < moved.size(); ++v) moved[sweep.in_mesh(v)] = Vec3f(positions[v]);
  return commit(mesh, std::move(moved), iterations, context);
}

}  // namespace burnish
