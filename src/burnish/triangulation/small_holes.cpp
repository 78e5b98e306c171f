#include "burnish/triangulation/small_holes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "burnish/triangulation/triangle_gap.h"

namespace burnish {
namespace {

using Corner = ManifoldSurface::Corner;
using Loop = std::vector<std::uint32_t>;

/// How many times worse a triangle is for each corner whose normal it turns away from.
constexpr double kFoldPenalty = 8;
/// An island has at most so many vertices for one of its rim.
constexpr std::size_t kIsland = 8;

/// The boundary loops of three to `max_edges` different vertices, each from its smallest corner,
/// with the gap on the left.
std::vector<Loop> small_loops(ManifoldSurface& surface, std::size_t max_edges) {
  const std::vector<Corner> corners = surface.corners();
  std::vector<std::uint32_t> first(surface.vertex_count() + 1, 0);
  for (const Corner& corner : corners) ++first[corner.vertex + 1];
  for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
  std::vector<Loop> loops;
  std::vector<bool> seen(corners.size(), false);
  for (std::uint32_t start = 0; start < corners.size(); ++start) {
    Loop loop;
    for (std::uint32_t at = start; !seen[at];) {
      seen[at] = true;
      loop.push_back(corners[at].vertex);
      std::uint32_t next = first[corners[at].to];
      while (corners[next].from != corners[at].vertex) ++next;
      at = next;
    }
    if (loop.size() < 3 || loop.size() > max_edges) continue;
    Loop sorted = loop;
    std::sort(sorted.begin(), sorted.end());
    const bool pinched = std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
    if (!pinched) loops.push_back(std::move(loop));
  }
  return loops;
}

/// The best triangulation of one loop.
class LoopTriangulation {
 public:
  LoopTriangulation(const ManifoldSurface& surface, std::span<const Vec3f> positions,
                    std::span<const Vec3f> normals, const Fans& fans, double max_gap)
      : surface_(surface),
        positions_(positions),
        normals_(normals),
        fans_(fans),
        max_gap_(max_gap) {}

  /// Whether `loop` is not the rim of an island: whether what fills it looks along the normals, or
  /// belongs to much more than it.
  bool is_hole(const Loop& loop) const {
    if (surface_.is_larger(loop[0], kIsland * loop.size())) return true;
    const Vec3d first(positions_[loop[0]]);
    Vec3d area, normal;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t next = loop[i + 1 < loop.size() ? i + 1 : 0];
      area += cross(Vec3d(positions_[loop[i]]) - first, Vec3d(positions_[next]) - first);
      normal += Vec3d(normals_[loop[i]]);
    }
    return dot(area, normal) > 0;
  }

  /// Appends triangles that fill `loop`; none where there is no way.
  void append(const Loop& loop, std::vector<Triangle>& triangles) {
    const std::size_t n = loop.size();
    cost_.assign(n * n, 0);
    apex_.assign(n * n, 0);
    for (std::size_t span = 2; span < n; ++span) {
      for (std::size_t i = 0; i + span < n; ++i) {
        const std::size_t k = i + span;
        double& best = cost_[i * n + k];
        best = std::numeric_limits<double>::infinity();
        if (span < n - 1 && is_edge(loop[i], loop[k])) continue;
        for (std::size_t j = i + 1; j < k; ++j) {
          const double sum = cost_[i * n + j] + cost_[j * n + k] + cost(loop[i], loop[j], loop[k]);
          if (sum < best) best = sum, apex_[i * n + k] = j;
        }
      }
    }
    if (std::isfinite(cost_[n - 1])) collect(loop, 0, n - 1, triangles);
  }

 private:
  bool is_edge(std::uint32_t a, std::uint32_t b) const {
    return surface_.has_edge(a, b) || surface_.has_edge(b, a);
  }

  double cost(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const Vec3d p(positions_[a]), q(positions_[b]), r(positions_[c]);
    const Vec3d area = cross(q - p, r - p);
    double fold = 1;
    for (const std::uint32_t v : {a, b, c}) {
      if (!(dot(area, Vec3d(normals_[v])) > 0)) fold *= kFoldPenalty;
    }
    const double spacing = std::max({fans_.spacing(a), fans_.spacing(b), fans_.spacing(c)});
    if (triangle_gap(p, q, r) > max_gap_ * spacing) return std::numeric_limits<double>::infinity();
    const double edges = squared_norm(q - p) + squared_norm(r - q) + squared_norm(p - r);
    return fold * edges / norm(area);
  }

  void collect(const Loop& loop, std::size_t i, std::size_t k,
               std::vector<Triangle>& triangles) const {
    if (k - i < 2) return;
    const std::size_t j = apex_[i * loop.size() + k];
    triangles.push_back({loop[i], loop[j], loop[k]});
    collect(loop, i, j, triangles);
    collect(loop, j, k, triangles);
  }

  const ManifoldSurface& surface_;
  std::span<const Vec3f> positions_, normals_;
  const Fans& fans_;
  double max_gap_;
  std::vector<double> cost_;
  std::vector<std::size_t> apex_;
};

}  // namespace

bool close_small_holes(ManifoldSurface& surface, std::span<const Vec3f> positions,
                       std::span<const Vec3f> normals, const Fans& fans, const HoleRule& rule,
                       const Context& context) {
  if (context.cancelled()) return false;
  LoopTriangulation triangulation(surface, positions, normals, fans, rule.max_gap);
  std::vector<Triangle> triangles;
  for (const Loop& loop : small_loops(surface, rule.max_edges)) {
    if (context.cancelled()) return false;
    if (!triangulation.is_hole(loop)) continue;
    triangles.clear();
    triangulation.append(loop, triangles);
    for (const Triangle& t : triangles) surface.add_if_manifold(t, Origin::invented);
  }
  return true;
}

}  // namespace burnish
