#include "burnish/points/orientation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

namespace burnish {
namespace {

/// Lighter links are all the same: 20 degrees between two normals.
constexpr double kLight = 1.0 / 16;
constexpr std::size_t kIslandNeighbours = 96;

/// So many points are dealt with between two looks at whether the run was cancelled.
constexpr std::size_t kBetweenLooks = std::size_t{1} << 16;

/// How far the normals of i and j look to the same side, -1 to 1. Along an arc from i to j the
/// normals are mirror images in the plane that bisects it, so that one is compared with the other's
/// mirror image: this holds across creases, where the normals themselves are at right angles.
double agreement(std::span<const Vec3f> positions, const std::vector<Vec3f>& normals,
                 std::uint32_t i, std::uint32_t j) {
  const Vec3d between = Vec3d(positions[j]) - Vec3d(positions[i]);
  const Vec3d m(normals[i]), n(normals[j]);
  const double length = squared_norm(between);
  if (!(length > 0)) return dot(m, n);
  const double rise_i = dot(m, between), rise_j = dot(n, between);
  const double steep = std::max(rise_i * rise_i, rise_j * rise_j) / length;
  return (dot(m, n) - 2 * rise_i * rise_j / length) * (1 - steep);
}

/// Disjoint sets whose elements know whether they look the other way than their set's root.
class OrientedSets {
 public:
  struct Place {
    std::uint32_t root;
    bool opposite;
  };

  explicit OrientedSets(std::size_t count) : parent_(count), opposite_(count), size_(count, 1) {
    for (std::uint32_t i = 0; i < count; ++i) parent_[i] = i;
  }

  Place find(std::uint32_t i) {
    std::uint8_t opposite = 0;
    while (parent_[i] != i) {
      const std::uint32_t p = parent_[i];
      opposite_[i] ^= opposite_[p];
      parent_[i] = parent_[p];
      opposite ^= opposite_[i];
      i = parent_[i];
    }
    return {i, opposite != 0};
  }

  std::uint32_t size(std::uint32_t root) const { return size_[root]; }

  void unite(const Place& a, const Place& b, bool opposite) {
    const auto [large, small] =
        size_[a.root] >= size_[b.root] ? std::pair{a.root, b.root} : std::pair{b.root, a.root};
    parent_[small] = large;
    opposite_[small] = static_cast<std::uint8_t>((a.opposite != b.opposite) != opposite);
    size_[large] += size_[small];
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<std::uint8_t> opposite_;  ///< to the parent; 0 for a root
  std::vector<std::uint32_t> size_;     ///< of a root's set
};

struct Link {
  double weight;
  std::uint32_t a, b;

  friend bool operator<(const Link& l, const Link& m) {
    return std::tie(l.weight, l.a, l.b) < std::tie(m.weight, m.a, m.b);
  }
};

/// Kruskal's spanning tree, which need not be kept: the sets know how their points look. Links
/// between points that are in one set already are never weighed, and these are nearly all.
class SpanningTree {
 public:
  SpanningTree(std::span<const Vec3f> positions, const NeighbourGrid& grid,
               const NeighbourLists& neighbours, const std::vector<Vec3f>& normals,
               const Context& context)
      : positions_(positions),
        grid_(grid),
        neighbours_(neighbours),
        normals_(normals),
        context_(context),
        sets_(normals.size()),
        apart_(normals.size() -
               static_cast<std::size_t>(std::count(normals.begin(), normals.end(), Vec3f{}))) {}

  /// Returns false where cancelled.
  bool build() { return join_light() && join_heavy() && join_islands(); }
  OrientedSets& sets() { return sets_; }

 private:
  /// The light links, which are as good as each other: those to the nearest neighbours first.
  bool join_light() {
    for (std::size_t k = 0; k < neighbours_.count() && apart_ > 1; ++k) {
      for (std::uint32_t i = 0; i < normals_.size(); ++i) {
        if (i % kBetweenLooks == 0 && context_.cancelled()) return false;
        const auto link = link_between_sets(i, neighbours_.of(i)[k]);
        if (link && link->weight < kLight) join(*link);
      }
    }
    return true;
  }

  /// The others, from the lightest to the heaviest.
  bool join_heavy() {
    std::vector<Link> heavy;
    for (std::uint32_t i = 0; i < normals_.size() && apart_ > 1; ++i) {
      if (i % kBetweenLooks == 0 && context_.cancelled()) return false;
      for (std::size_t k = 0; k < neighbours_.count(); ++k) {
        if (auto link = link_between_sets(i, neighbours_.of(i)[k])) heavy.push_back(*link);
      }
    }
    std::sort(heavy.begin(), heavy.end());
    for (const Link& link : heavy) join(link);
    return !context_.cancelled();
  }

  /// Where the sampling is much denser along lines than across them, all neighbours may be on the
  /// line: what is apart from the largest set looks further for light links.
  bool join_islands() {
    if (apart_ <= 1) return true;
    const std::uint32_t largest = largest_set();
    std::vector<Neighbour> found;
    for (std::uint32_t i = 0; i < normals_.size(); ++i) {
      if (i % kBetweenLooks == 0 && context_.cancelled()) return false;
      if (normals_[i] == Vec3f{} || sets_.find(i).root == largest) continue;
      grid_.nearest(positions_[i], kIslandNeighbours, found);
      for (const Neighbour& neighbour : found) {
        const auto link = link_between_sets(i, neighbour.index);
        if (link && link->weight < kLight) join(*link);
      }
    }
    return true;
  }

  std::uint32_t largest_set() {
    std::uint32_t largest = 0;
    for (std::uint32_t i = 0; i < normals_.size(); ++i) {
      const std::uint32_t root = sets_.find(i).root;
      if (sets_.size(root) > sets_.size(largest)) largest = root;
    }
    return largest;
  }

  /// The link of points i and j, if it joins two sets.
  std::optional<Link> link_between_sets(std::uint32_t i, std::uint32_t j) {
    if (normals_[i] == Vec3f{} || normals_[j] == Vec3f{}) return {};
    if (sets_.find(i).root == sets_.find(j).root) return {};
    const std::uint32_t a = std::min(i, j), b = std::max(i, j);
    return Link{1 - std::abs(agreement(positions_, normals_, a, b)), a, b};
  }

  void join(const Link& link) {
    const OrientedSets::Place a = sets_.find(link.a), b = sets_.find(link.b);
    if (a.root == b.root) return;
    sets_.unite(a, b, agreement(positions_, normals_, link.a, link.b) < 0);
    --apart_;
  }

  std::span<const Vec3f> positions_;
  const NeighbourGrid& grid_;
  const NeighbourLists& neighbours_;
  const std::vector<Vec3f>& normals_;
  const Context& context_;
  OrientedSets sets_;
  std::size_t apart_;  ///< sets that hold a normal
};

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// The points of a set that are farthest out along -x, +x, -y, +y, -z and +z, of equally far ones
/// those of the smallest index.
class Extremes {
 public:
  void extend(std::span<const Vec3f> positions, std::uint32_t i) {
    for (std::size_t side = 0; side < 6; ++side) {
      std::uint32_t& farthest = farthest_[side];
      if (farthest == kNone || out(positions[i], side) > out(positions[farthest], side)) {
        farthest = i;
      }
    }
  }

  /// Whether the normals, as `normal_of` gives them, look inwards: on a closed surface all six look
  /// out; on an open one they may contradict each other, and the top decides.
  template <class NormalOf>
  bool look_inwards(NormalOf normal_of) const {
    double outwards = 0;
    for (std::size_t side = 0; side < 6; ++side) outwards += out(normal_of(farthest_[side]), side);
    return std::abs(outwards) > kClear ? outwards < 0 : normal_of(farthest_[5]).z < 0;
  }

 private:
  static constexpr double kClear = 2;

  static float out(const Vec3f& v, std::size_t side) {
    return side % 2 ? v[side / 2] : -v[side / 2];
  }

  std::array<std::uint32_t, 6> farthest_{kNone, kNone, kNone, kNone, kNone, kNone};
};

}  // namespace

std::size_t orient_consistently(std::span<const Vec3f> positions, const NeighbourGrid& grid,
                                const NeighbourLists& neighbours, std::vector<Vec3f>& normals,
                                const Context& context) {
  SpanningTree tree(positions, grid, neighbours, normals, context);
  if (!tree.build()) return 0;
  std::vector<std::uint32_t> component(normals.size(), kNone);  // at its root's place
  std::vector<Extremes> extremes;
  for (std::uint32_t i = 0; i < normals.size(); ++i) {
    if (normals[i] == Vec3f{}) continue;
    const auto [root, opposite] = tree.sets().find(i);
    if (component[root] == kNone) {
      component[root] = static_cast<std::uint32_t>(extremes.size());
      extremes.emplace_back();
    }
    extremes[component[root]].extend(positions, i);
    if (opposite) normals[i] = -normals[i];
  }
  std::vector<bool> inwards;
  for (const Extremes& of_component : extremes) {
    inwards.push_back(of_component.look_inwards([&](std::uint32_t i) { return normals[i]; }));
  }
  for (std::uint32_t i = 0; i < normals.size(); ++i) {
    if (normals[i] == Vec3f{}) continue;
    if (inwards[component[tree.sets().find(i).root]]) normals[i] = -normals[i];
  }
  context.progress(1);
  return extremes.size();
}

}  // namespace burnish
