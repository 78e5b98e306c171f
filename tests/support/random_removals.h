#pragma once

#include <algorithm>
#include <set>
#include <vector>

#include "burnish/adaptation/removal.h"
#include "burnish/base/random.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish::test {

/// Makes half-edge collapses at random places, plainly.
class RandomCollapser {
 public:
  RandomCollapser(const TriangleMesh& mesh, std::uint64_t seed)
      : triangles_(mesh.triangles), stars_(mesh.positions.size()), random_(seed) {
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      for (const std::uint32_t v : triangles_[t]) stars_[v].insert(t);
    }
  }

  /// At most `tries` attempts; the error rises or stays.
  std::vector<Removal> removals(std::size_t tries) {
    std::vector<Removal> log;
    float error = 0;
    for (std::size_t i = 0; i < tries && !stars_.empty(); ++i) {
      const auto vertex = static_cast<std::uint32_t>(random_.below(stars_.size()));
      if (stars_[vertex].empty()) continue;
      auto chosen = stars_[vertex].begin();
      std::advance(chosen, static_cast<std::ptrdiff_t>(random_.below(stars_[vertex].size())));
      const std::uint32_t into = triangles_[*chosen][random_.below(3)];
      if (!legal(vertex, into)) continue;
      if (random_.below(3) > 0) error += static_cast<float>(0.001 * random_.uniform());
      collapse(vertex, into);
      log.push_back({vertex, into, error});
    }
    return log;
  }

 private:
  using Vertices = std::set<std::uint32_t>;

  /// The neighbours of a vertex whose star is one fan without a triangle that is none, and on how
  /// many sides it is open (0 or 2); no neighbours for any other vertex.
  struct Ring {
    Vertices all, open;
  };
  Ring ring_of(std::uint32_t vertex) const {
    std::multiset<std::uint32_t> seen;
    std::set<Vertices> distinct;
    for (const std::uint32_t t : stars_[vertex]) {
      const Vertices corners(triangles_[t].begin(), triangles_[t].end());
      if (corners.size() < 3 || !distinct.insert(corners).second) return {};
      for (const std::uint32_t v : corners) {
        if (v != vertex) seen.insert(v);
      }
    }
    Ring ring;
    for (const std::uint32_t v : seen) {
      if (seen.count(v) > 2) return {};
      ring.all.insert(v);
      if (seen.count(v) == 1) ring.open.insert(v);
    }
    // Opened or closed, one fan has as many edges as neighbours, or one less.
    const std::size_t fans = ring.open.size() / 2;
    if (fans > 1 || !connected(vertex, ring)) return {};
    return ring;
  }

  /// Whether the triangles at a vertex hang together along their edges at it.
  bool connected(std::uint32_t vertex, const Ring& ring) const {
    Vertices reached{*ring.all.begin()};
    for (bool grew = true; grew;) {
      grew = false;
      for (const std::uint32_t t : stars_[vertex]) {
        const auto& corners = triangles_[t];
        if (std::none_of(corners.begin(), corners.end(),
                         [&](std::uint32_t v) { return reached.count(v) > 0; }))
          continue;
        for (const std::uint32_t v : corners)
          grew = (v != vertex && reached.insert(v).second) || grew;
      }
    }
    return reached.size() == ring.all.size();
  }

  /// The link condition (Dey et al. 1999), with what is open as in a mesh closed by a further
  /// vertex.
  bool legal(std::uint32_t vertex, std::uint32_t into) const {
    if (vertex == into) return false;
    const Ring mine = ring_of(vertex);
    const Ring its = ring_of(into);
    if (mine.all.count(into) == 0 || its.all.empty()) return false;
    Vertices common;
    std::set_intersection(mine.all.begin(), mine.all.end(), its.all.begin(), its.all.end(),
                          std::inserter(common, common.end()));
    const bool open_edge = mine.open.count(into) > 0;
    if (common.size() != (open_edge ? 1u : 2u)) return false;
    if (!mine.open.empty() && !its.open.empty() && !open_edge) return false;
    // What is left must be more than the edge: no two triangles upon each other.
    return stars_[vertex].size() + stars_[into].size() > (open_edge ? 2u : 6u) &&
           (!open_edge || apart(*common.begin(), vertex, into));
  }

  /// Whether an open triangle's third vertex has a triangle besides it.
  bool apart(std::uint32_t apex, std::uint32_t, std::uint32_t) const {
    return stars_[apex].size() > 1;
  }

  void collapse(std::uint32_t vertex, std::uint32_t into) {
    const std::set<std::uint32_t> star = std::move(stars_[vertex]);
    stars_[vertex].clear();
    for (const std::uint32_t t : star) {
      Triangle& triangle = triangles_[t];
      if (std::count(triangle.begin(), triangle.end(), into) > 0) {
        for (const std::uint32_t v : triangle) stars_[v].erase(t);
      } else {
        std::replace(triangle.begin(), triangle.end(), vertex, into);
        stars_[into].insert(t);
      }
    }
  }

  std::vector<Triangle> triangles_;
  std::vector<std::set<std::uint32_t>> stars_;
  Random random_;
};

/// What `removals` leave of a mesh, plainly: vertices and triangles in their order, owners only
/// where nothing was removed.
inline TriangleMesh after_removals(TriangleMesh mesh, std::span<const Removal> removals) {
  if (removals.empty()) return mesh;
  std::vector<bool> gone(mesh.positions.size());
  std::vector<std::uint32_t> kept_triangles, kept;
  std::vector<bool> flat(mesh.triangles.size());
  for (const Removal& removal : removals) {
    gone[removal.vertex] = true;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      Triangle& triangle = mesh.triangles[t];
      if (flat[t] || std::count(triangle.begin(), triangle.end(), removal.vertex) == 0) continue;
      flat[t] = std::count(triangle.begin(), triangle.end(), removal.into) > 0;
      std::replace(triangle.begin(), triangle.end(), removal.vertex, removal.into);
    }
  }
  for (std::uint32_t t = 0; t < flat.size(); ++t) {
    if (!flat[t]) kept_triangles.push_back(t);
  }
  mesh.triangle_attributes.owner.clear();
  keep_triangles(mesh, kept_triangles);
  std::vector<std::uint32_t> names(mesh.positions.size());
  for (std::uint32_t v = 0; v < gone.size(); ++v) {
    names[v] = static_cast<std::uint32_t>(kept.size());
    if (!gone[v]) kept.push_back(v);
  }
  mesh.positions = gather(mesh.positions, kept);
  mesh.attributes = gather(mesh.attributes, kept);
  for (Triangle& triangle : mesh.triangles) {
    for (std::uint32_t& v : triangle) v = names[v];
  }
  return mesh;
}

}  // namespace burnish::test
