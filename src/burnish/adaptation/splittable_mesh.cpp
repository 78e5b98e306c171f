#include "burnish/adaptation/splittable_mesh.h"

#include <algorithm>
#include <numeric>

namespace burnish {
namespace {

constexpr std::uint32_t kNoSide = ~0u;

/// The corner of `t` that is neither end of an edge; where there is none, the edge's end `a`.
std::uint32_t third_corner(const Triangle& t, std::uint32_t a, std::uint32_t b) {
  for (const std::uint32_t v : t) {
    if (v != a && v != b) return v;
  }
  return a;
}

Triangle with(Triangle t, std::uint32_t instead_of, std::uint32_t v) {
  std::replace(t.begin(), t.end(), instead_of, v);
  return t;
}

}  // namespace

SplittableMesh::SplittableMesh(const TriangleMesh& mesh, const EdgeTable& edges)
    : positions_(mesh.positions), triangles_(mesh.triangles) {
  origins_.resize(triangles_.size());
  std::iota(origins_.begin(), origins_.end(), 0u);
  next_.assign(3 * triangles_.size(), kNoSide);
  edge_.assign(3 * triangles_.size(), kNoEdge);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto [a, b] = edges.vertices(e);
    const std::uint32_t edge = add_edge(a, b);
    for (const std::uint32_t side : edges.sides(e)) join(edge, side);
  }
}

double SplittableMesh::squared_length(std::uint32_t edge) const {
  const auto [a, b] = ends_[edge];
  return squared_norm(Vec3d(positions_[a]) - Vec3d(positions_[b]));
}

std::uint32_t SplittableMesh::longest_beside(std::uint32_t edge) const {
  std::uint32_t longest = edge;
  double length = squared_length(edge);
  for (std::uint32_t side = first_[edge]; side != kNoSide; side = next_[side]) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t other = edge_[side - side % 3 + i];
      if (other == kNoEdge || other == edge) continue;
      const double other_length = squared_length(other);
      if (other_length > length || (other_length == length && other < longest)) {
        longest = other;
        length = other_length;
      }
    }
  }
  return longest;
}

std::uint32_t SplittableMesh::add_edge(std::uint32_t a, std::uint32_t b) {
  ends_.push_back({a, b});
  first_.push_back(kNoSide);
  return static_cast<std::uint32_t>(ends_.size() - 1);
}

void SplittableMesh::join(std::uint32_t edge, std::uint32_t side) {
  edge_[side] = edge;
  next_[side] = first_[edge];
  first_[edge] = side;
}

void SplittableMesh::replace(std::uint32_t edge, std::uint32_t side, std::uint32_t by) {
  std::uint32_t* link = &first_[edge];
  while (*link != side) link = &next_[*link];
  *link = by;
  next_[by] = next_[side];
  edge_[by] = edge;
}

/// Each triangle once, by its third corner.
void SplittableMesh::collect_triangles(std::uint32_t edge) {
  const auto [a, b] = ends_[edge];
  wings_.clear();
  for (std::uint32_t side = first_[edge]; side != kNoSide; side = next_[side]) {
    const std::uint32_t t = side / 3;
    const bool again =
        (side % 3 > 0 && edge_[3 * t] == edge) || (side % 3 > 1 && edge_[3 * t + 1] == edge);
    if (!again) wings_.push_back({third_corner(triangles_[t], a, b), t});
  }
  std::sort(wings_.begin(), wings_.end(), [](const Wing& v, const Wing& w) {
    return v.corner != w.corner ? v.corner < w.corner : v.triangle < w.triangle;
  });
}

std::span<const std::uint32_t> SplittableMesh::split(std::uint32_t edge, const Vec3f& place) {
  const auto [a, b] = ends_[edge];
  const auto m = static_cast<std::uint32_t>(positions_.size());
  collect_triangles(edge);
  positions_.push_back(place);
  parents_.push_back({a, b});
  ends_[edge] = {a, m};
  first_[edge] = kNoSide;
  halves_ = {edge, add_edge(m, b), a, b, m};
  changed_.assign({halves_.edge, halves_.other});
  for (std::size_t i = 0; i < wings_.size(); ++i) {
    const auto [corner, triangle] = wings_[i];
    // Triangles with the same third corner have the edge from there to m in common.
    if (corner != a && (i == 0 || corner != wings_[i - 1].corner)) {
      changed_.push_back(add_edge(m, corner));
    }
    split_triangle(triangle, changed_.back());
  }
  return changed_;
}

void SplittableMesh::split_triangle(std::uint32_t t, std::uint32_t median) {
  const auto u = static_cast<std::uint32_t>(triangles_.size());
  const Triangle corners = triangles_[t];
  triangles_[t] = with(corners, halves_.b, halves_.m);
  triangles_.push_back(with(corners, halves_.a, halves_.m));
  origins_.push_back(origins_[t]);
  next_.insert(next_.end(), 3, kNoSide);
  edge_.insert(edge_.end(), 3, kNoEdge);
  for (std::uint32_t i = 0; i < 3; ++i) {
    const std::uint32_t at_t = 3 * t + i, at_u = 3 * u + i, old = edge_[at_t];
    if (old == kNoEdge) continue;
    if (old == halves_.edge) {
      join(halves_.edge, at_t);
      join(halves_.other, at_u);
    } else if (corners[i] == halves_.b || corners[(i + 1) % 3] == halves_.b) {
      replace(old, at_t, at_u);
      join(median, at_t);
    } else {
      join(median, at_u);
    }
  }
}

}  // namespace burnish
