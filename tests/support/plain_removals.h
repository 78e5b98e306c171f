#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "burnish/adaptation/removal.h"
#include "burnish/base/random.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish::test {

/// Removals as plain as they come: every question is answered by looking at all triangles around.
class PlainRemovals {
 public:
  explicit PlainRemovals(TriangleMesh mesh)
      : mesh_(std::move(mesh)),
        there_(mesh_.triangles.size(), true),
        removed_(mesh_.positions.size(), false),
        around_(mesh_.positions.size()) {
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (const std::uint32_t v : mesh_.triangles[t]) around_[v].insert(t);
    }
  }

  std::vector<std::uint32_t> neighbours(std::uint32_t v) const {
    std::set<std::uint32_t> found;
    for (const std::uint32_t t : around_[v]) {
      found.insert(mesh_.triangles[t].begin(), mesh_.triangles[t].end());
    }
    found.erase(v);
    return {found.begin(), found.end()};
  }

  /// Whether the surface is the same, but for its shape, once `v` is merged into its neighbour `w`.
  bool legal(std::uint32_t v, std::uint32_t w) const {
    std::map<std::uint32_t, std::vector<std::uint32_t>> spokes;
    for (const std::uint32_t t : around_[v]) {
      if (names_twice(t)) return false;
      for (const std::uint32_t x : mesh_.triangles[t]) {
        if (x != v) spokes[x].push_back(t);
      }
    }
    if (!spokes.count(w) || !is_disc(v, spokes)) return false;
    const std::size_t ends = open_ends(spokes);
    if (ends == 2 && spokes[w].size() != 1) return false;
    const std::vector<std::uint32_t> beside = neighbours(w);
    std::size_t common = 0;
    for (const auto& spoke : spokes) {
      common += std::binary_search(beside.begin(), beside.end(), spoke.first);
    }
    return common == spokes[w].size() && ear_is_held(v, w) && makes_no_double(v, w);
  }

  /// `v` into `w`, legal or not.
  void remove(std::uint32_t v, std::uint32_t w) {
    removed_[v] = true;
    const std::set<std::uint32_t> star = around_[v];
    for (const std::uint32_t t : star) {
      Triangle& corners = mesh_.triangles[t];
      if (has(t, w)) {
        there_[t] = false;
        for (const std::uint32_t x : corners) around_[x].erase(t);
      } else {
        std::replace(corners.begin(), corners.end(), v, w);
        around_[w].insert(t);
      }
    }
    around_[v].clear();
  }

  /// What is left: the vertices that were not removed and the triangles, both in their order.
  TriangleMesh mesh() const {
    std::vector<std::uint32_t> kept, triangles, renamed(removed_.size());
    for (std::uint32_t v = 0; v < removed_.size(); ++v) {
      renamed[v] = static_cast<std::uint32_t>(kept.size());
      if (!removed_[v]) kept.push_back(v);
    }
    for (std::uint32_t t = 0; t < there_.size(); ++t) {
      if (there_[t]) triangles.push_back(t);
    }
    TriangleMesh result{gather(mesh_.positions, kept),
                        gather(mesh_.triangles, triangles),
                        gather(mesh_.attributes, kept),
                        mesh_.frame,
                        {gather(mesh_.triangle_attributes.origin, triangles), {}}};
    for (Triangle& t : result.triangles) {
      for (std::uint32_t& v : t) v = renamed[v];
    }
    return result;
  }

 private:
  using Spokes = std::map<std::uint32_t, std::vector<std::uint32_t>>;

  bool has(std::uint32_t t, std::uint32_t v) const {
    const Triangle& corners = mesh_.triangles[t];
    return std::find(corners.begin(), corners.end(), v) != corners.end();
  }

  bool names_twice(std::uint32_t t) const {
    const auto [a, b, c] = mesh_.triangles[t];
    return a == b || b == c || c == a;
  }

  static std::size_t open_ends(const Spokes& spokes) {
    return static_cast<std::size_t>(std::count_if(
        spokes.begin(), spokes.end(), [](const auto& spoke) { return spoke.second.size() == 1; }));
  }

  /// One fan, closed or open: all triangles hang together, two at each edge but at two ends.
  bool is_disc(std::uint32_t v, const Spokes& spokes) const {
    for (const auto& spoke : spokes) {
      if (spoke.second.size() > 2) return false;
    }
    const std::size_t ends = open_ends(spokes);
    if (ends != 0 && ends != 2) return false;
    if (ends == 0 && around_[v].size() < 3) return false;
    std::set<std::uint32_t> seen{*around_[v].begin()};
    for (bool grown = true; grown;) {
      grown = false;
      for (const auto& spoke : spokes) {
        const auto& both = spoke.second;
        if (both.size() < 2 || seen.count(both[0]) == seen.count(both[1])) continue;
        seen.insert(both.begin(), both.end());
        grown = true;
      }
    }
    return seen.size() == around_[v].size();
  }

  /// A triangle that holds on to the rest by one edge only may go, one that stands alone may not.
  bool ear_is_held(std::uint32_t v, std::uint32_t w) const {
    if (around_[v].size() != 1) return true;
    const std::uint32_t ear = *around_[v].begin();
    std::size_t beyond = 0;
    for (const std::uint32_t x : mesh_.triangles[ear]) {
      if (x == v || x == w) continue;
      for (const std::uint32_t t : around_[w]) {
        if (t != ear && has(t, x)) beyond += names_twice(t) ? 2 : 1;
      }
    }
    return beyond == 1;
  }

  bool makes_no_double(std::uint32_t v, std::uint32_t w) const {
    for (const std::uint32_t t : around_[v]) {
      if (has(t, w)) continue;
      for (const std::uint32_t u : around_[w]) {
        int shared = 0;
        for (const std::uint32_t x : mesh_.triangles[t]) shared += x != v && has(u, x);
        if (shared == 2) return false;
      }
    }
    return true;
  }

  TriangleMesh mesh_;
  std::vector<bool> there_, removed_;
  std::vector<std::set<std::uint32_t>> around_;
};

/// Up to `count` random legal removals of `mesh`, with errors that rise now and then. It gives up
/// when many vertices in a row could not be removed.
inline std::vector<Removal> random_removals(const TriangleMesh& mesh, std::size_t count,
                                            std::uint64_t seed) {
  PlainRemovals plain(mesh);
  Random random(seed);
  std::vector<Removal> log;
  float error = 0;
  const std::size_t patience = 20 + mesh.positions.size();
  for (std::size_t failed = 0; log.size() < count && failed < patience; ++failed) {
    const auto v = static_cast<std::uint32_t>(random.below(mesh.positions.size()));
    const std::vector<std::uint32_t> ring = plain.neighbours(v);
    if (ring.empty()) continue;
    const std::uint32_t into = ring[random.below(ring.size())];
    if (!plain.legal(v, into)) continue;
    plain.remove(v, into);
    error += static_cast<float>(random.below(3)) * 1e-4f;
    log.push_back({v, into, error});
    failed = 0;
  }
  return log;
}

}  // namespace burnish::test
