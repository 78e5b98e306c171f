#include "burnish/adaptation/blend.h"

#include <algorithm>
#include <utility>

namespace burnish {

std::vector<Ring> rings_of(const TriangleMesh& mesh, const EdgeTable& edges,
                           const std::vector<bool>& crease) {
  std::vector<Ring> rings(mesh.positions.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (!crease[e]) continue;
    for (const std::uint32_t v : edges.vertices(e)) rings[v].crease = true;
  }
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto [a, b] = edges.vertices(e);
    const auto join = [&](Ring& ring, std::uint32_t neighbour) {
      if (ring.crease && !crease[e]) return;
      ring.sum.add(mesh, neighbour, 1);
      ++ring.count;
    };
    join(rings[a], b);
    join(rings[b], a);
  }
  return rings;
}

Placement::Placement(const TriangleMesh& mesh, std::size_t new_vertices) {
  const std::size_t count = mesh.positions.size() + new_vertices;
  positions_.reserve(count);
  positions_ = mesh.positions;
  positions_.resize(count);
  if (!mesh.attributes.sigma.empty()) sigma_.resize(count);
}

void Placement::apply(TriangleMesh& mesh) && {
  mesh.positions = std::move(positions_);
  for (std::size_t v = 0; v < sigma_.size(); ++v) {
    float& sigma = mesh.attributes.sigma[v];
    sigma = std::max(sigma, sigma_[v]);
  }
}

}  // namespace burnish
