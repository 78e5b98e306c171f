#include "burnish/smoothing/closed_parts.h"

#include <cmath>

#include "burnish/core/disjoint_sets.h"
#include "burnish/core/edges.h"

namespace burnish {
namespace {

Vec3d middle(const std::vector<Vec3d>& positions, const std::vector<std::uint32_t>& vertices) {
  Vec3d sum;
  for (const std::uint32_t v : vertices) sum += positions[v];
  return sum / static_cast<double>(vertices.size());
}

double volume(const std::vector<Vec3d>& positions, const std::vector<Triangle>& triangles,
              const Vec3d& from) {
  double sum = 0;
  for (const auto& [a, b, c] : triangles) {
    sum += dot(positions[a] - from, cross(positions[b] - from, positions[c] - from));
  }
  return sum / 6;
}

}  // namespace

ClosedParts::ClosedParts(const TriangleMesh& mesh, const std::vector<Vec3d>& positions,
                         const std::vector<bool>& held) {
  const std::size_t count = positions.size();
  DisjointSets sets(count);
  for (const auto& [a, b, c] : mesh.triangles) {
    sets.unite(a, b);
    sets.unite(b, c);
  }
  std::vector<bool> closed(count, true);
  for (const Edge& edge : edges(mesh)) {
    if (edge.triangles != 2 || edge.flipped()) closed[sets.find(edge.vertices[0])] = false;
  }
  for (std::uint32_t v = 0; v < count; ++v) {
    if (held[v]) closed[sets.find(v)] = false;
  }
  constexpr std::uint32_t kNone = UINT32_MAX;
  std::vector<std::uint32_t> part_of(count, kNone);
  for (const Triangle& t : mesh.triangles) {
    const std::uint32_t root = sets.find(t[0]);
    if (!closed[root]) continue;
    if (part_of[root] == kNone) {
      part_of[root] = static_cast<std::uint32_t>(parts_.size());
      parts_.emplace_back();
    }
    parts_[part_of[root]].triangles.push_back(t);
  }
  for (std::uint32_t v = 0; v < count; ++v) {
    const std::uint32_t part = part_of[sets.find(v)];
    if (part != kNone) parts_[part].vertices.push_back(v);
  }
  for (Part& part : parts_) {
    part.volume = volume(positions, part.triangles, middle(positions, part.vertices));
  }
}

void ClosedParts::restore(std::vector<Vec3d>& positions) const {
  for (const Part& part : parts_) {
    const Vec3d centre = middle(positions, part.vertices);
    const double ratio = part.volume / volume(positions, part.triangles, centre);
    if (!(ratio > 0 && std::isfinite(ratio))) continue;
    const double factor = std::cbrt(ratio);
    for (const std::uint32_t v : part.vertices) {
      positions[v] = centre + factor * (positions[v] - centre);
    }
  }
}

}  // namespace burnish
