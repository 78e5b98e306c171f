#include "burnish/smoothing/ring_filter.h"

#include <utility>

#include "burnish/base/parallel.h"
#include "burnish/core/adjacency.h"

namespace burnish {
namespace {

/// The neighbours that each vertex is smoothed with; none where it is to stay.
Adjacency smoothing_rings(const TriangleMesh& mesh, BoundaryRule boundary) {
  const Adjacency rings = one_rings(mesh);
  if (boundary == BoundaryRule::free) return rings;
  const std::vector<bool> on_boundary = boundary_vertices(mesh);
  const Adjacency along = boundary_neighbours(mesh);
  std::vector<std::uint32_t> offsets{0}, items;
  offsets.reserve(rings.size() + 1);
  items.reserve(rings.items().size());
  for (std::size_t v = 0; v < rings.size(); ++v) {
    const auto row = !on_boundary[v]                          ? rings.row(v)
                     : boundary == BoundaryRule::along_boundary ? along.row(v)
                                                              : std::span<const std::uint32_t>{};
    items.insert(items.end(), row.begin(), row.end());
    offsets.push_back(static_cast<std::uint32_t>(items.size()));
  }
  return {std::move(offsets), std::move(items)};
}

}  // namespace

Result<SmoothingReport> filter_rings(TriangleMesh& mesh, int iterations, BoundaryRule boundary,
                                     const Context& context, const RingRule& rule) {
  if (auto sound = check(mesh); !sound) return sound.error();
  const Adjacency rings = smoothing_rings(mesh, boundary);
  std::vector<Vec3f> positions = mesh.positions, next = mesh.positions;
  for (int pass = 0; pass < iterations; ++pass) {
    const bool complete = parallel_for(
        context.part(static_cast<double>(pass) / iterations, (pass + 1.0) / iterations),
        positions.size(), [&](IndexRange range) {
          for (std::size_t v = range.begin; v < range.end; ++v) {
            const auto ring = rings.row(v);
            if (!ring.empty()) next[v] = Vec3f(rule(static_cast<std::uint32_t>(v), ring, positions));
          }
        });
    if (!complete) return cancelled();
    std::swap(positions, next);
  }
  std::swap(mesh.positions, positions);
  if (!mesh.attributes.normals.empty()) mesh.attributes.normals = vertex_normals(mesh);
  context.progress(1);
  return report_moves(iterations == 0 ? mesh.positions : positions, mesh, iterations);
}

}  // namespace burnish
