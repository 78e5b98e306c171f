#include "burnish/repair/manifold_cuts.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>

#include "burnish/core/disjoint_sets.h"
#include "burnish/core/edge_table.h"

namespace burnish {
namespace {

constexpr std::uint32_t kNone = ~0u;

std::uint32_t next(std::uint32_t side) {
  return side % 3 == 2 ? side - 2 : side + 1;
}

/// Of a side, the vertex where it begins.
std::uint32_t start(const TriangleMesh& mesh, std::uint32_t side) {
  return mesh.triangles[side / 3][side % 3];
}

// ---------------------------------------------------------------- triangles that go

bool is_degenerate(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// Whether the vertices run the way in which sorting them leaves them.
bool runs_up(const Triangle& t) {
  return (t[0] < t[1]) + (t[1] < t[2]) + (t[2] < t[0]) == 2;
}

/// Of triangles with the same vertices the first that runs as most of them do; none where as many
/// run either way, which is two sheets that lie on each other with nothing between.
std::optional<std::uint32_t> one_of(const TriangleMesh& mesh,
                                    std::span<const std::uint32_t> alike) {
  std::ptrdiff_t more_up = 0;
  for (const std::uint32_t t : alike) more_up += runs_up(mesh.triangles[t]) ? 1 : -1;
  if (more_up == 0) return {};
  return *std::find_if(alike.begin(), alike.end(), [&](std::uint32_t t) {
    return runs_up(mesh.triangles[t]) == (more_up > 0);
  });
}

/// The triangles that stay, rising.
std::vector<std::uint32_t> proper_triangles(const TriangleMesh& mesh, ManifoldReport& report) {
  const auto vertices = [&](std::uint32_t t) {
    Triangle sorted = mesh.triangles[t];
    std::sort(sorted.begin(), sorted.end());
    return sorted;
  };
  std::vector<std::uint32_t> proper;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!is_degenerate(mesh.triangles[t])) proper.push_back(t);
  }
  report.degenerate_triangles = mesh.triangles.size() - proper.size();
  std::sort(proper.begin(), proper.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Triangle of_a = vertices(a), of_b = vertices(b);
    return of_a != of_b ? of_a < of_b : a < b;
  });
  std::vector<std::uint32_t> kept;
  for (std::size_t first = 0, last; first < proper.size(); first = last) {
    last = first + 1;
    while (last < proper.size() && vertices(proper[last]) == vertices(proper[first])) ++last;
    const auto one = one_of(mesh, std::span(proper).subspan(first, last - first));
    if (one) kept.push_back(*one);
  }
  report.duplicate_triangles = proper.size() - kept.size();
  std::sort(kept.begin(), kept.end());
  return kept;
}

// ---------------------------------------------------------------- sides that stay joined

/// Pairs the sides of a singular edge that have matter between them: about the edge, which they
/// all lie along, every side that runs against it is followed by one that runs with it. Nothing
/// where they do not alternate.
std::vector<std::array<std::uint32_t, 2>> pairs_around(const TriangleMesh& mesh,
                                                       std::array<std::uint32_t, 2> edge,
                                                       std::span<const std::uint32_t> sides) {
  struct Page {
    double angle;
    std::uint32_t side;
    bool with_edge;
  };
  const Vec3d from(mesh.positions[edge[0]]);
  const Vec3d axis = normalized(Vec3d(mesh.positions[edge[1]]) - from);
  std::vector<Page> pages;
  Vec3d right{}, up{};
  for (const std::uint32_t side : sides) {
    const Vec3d apex = Vec3d(mesh.positions[start(mesh, next(next(side)))]) - from;
    const Vec3d across = apex - axis * dot(apex, axis);
    if (pages.empty()) right = normalized(across), up = cross(axis, right);
    pages.push_back(
        {std::atan2(dot(across, up), dot(across, right)), side, start(mesh, side) == edge[0]});
  }
  std::sort(pages.begin(), pages.end(), [](const Page& a, const Page& b) {
    return a.angle != b.angle ? a.angle < b.angle : a.side < b.side;
  });
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (std::size_t i = 0; i < pages.size(); ++i) {
    const Page &page = pages[i], &after = pages[(i + 1) % pages.size()];
    const bool apart = std::isfinite(page.angle) && page.angle != after.angle;
    if (!apart || page.with_edge == after.with_edge) return {};
    if (!page.with_edge) pairs.push_back({page.side, after.side});
  }
  return pairs;
}

/// The other side of every side that stays joined to one; kNone along cuts and boundaries.
class Joints {
 public:
  Joints(const TriangleMesh& mesh, const EdgeTable& edges, bool keep_solids, ManifoldReport& report)
      : mesh_(mesh), edges_(edges), other_(3 * mesh.triangles.size(), kNone) {
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const std::span<const std::uint32_t> sides = edges.sides(e);
      if (sides.size() == 2) {
        const bool agree = start(mesh, sides[0]) != start(mesh, sides[1]);
        if (agree) join(sides[0], sides[1]);
        report.flipped_edges += !agree;
      } else if (sides.size() > 2) {
        ++report.singular_edges;
        if (!keep_solids) continue;
        for (const auto& [a, b] : pairs_around(mesh, edges.vertices(e), sides)) join(a, b);
      }
    }
  }

  std::uint32_t other(std::uint32_t side) const { return other_[side]; }

  /// Per corner the first of those that are one vertex with it.
  DisjointSets corners() const {
    DisjointSets sets(other_.size());
    for (std::uint32_t side = 0; side < other_.size(); ++side) {
      if (other_[side] == kNone) continue;
      sets.unite(side, next(other_[side]));
      sets.unite(next(side), other_[side]);
    }
    return sets;
  }

  /// Cuts the singular edges that two pairs of sides still share, as they do where one fan at
  /// either end goes through both. Whether there was one.
  bool cut_shared(DisjointSets& corners) {
    bool cut = false;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const std::span<const std::uint32_t> sides = edges_.sides(e);
      if (sides.size() <= 2 || other_[sides[0]] == kNone) continue;
      if (!has_shared(sides, edges_.vertices(e)[0], corners)) continue;
      for (const std::uint32_t side : sides) other_[side] = kNone;
      cut = true;
    }
    return cut;
  }

 private:
  void join(std::uint32_t a, std::uint32_t b) { other_[a] = b, other_[b] = a; }

  bool has_shared(std::span<const std::uint32_t> sides, std::uint32_t low,
                  DisjointSets& corners) const {
    std::vector<std::array<std::uint32_t, 2>> ends;
    for (const std::uint32_t side : sides) {
      const std::uint32_t from = corners.find(side), to = corners.find(next(side));
      if (start(mesh_, side) == low) {
        ends.push_back({from, to});
      } else {
        ends.push_back({to, from});
      }
    }
    std::sort(ends.begin(), ends.end());
    for (std::size_t i = 2; i < ends.size(); ++i) {
      if (ends[i] == ends[i - 2]) return true;
    }
    return false;
  }

  const TriangleMesh& mesh_;
  const EdgeTable& edges_;
  std::vector<std::uint32_t> other_;
};

// ---------------------------------------------------------------- vertices

/// A vertex for every set of corners: the first set of a vertex keeps its number, the others
/// follow.
std::size_t give_vertices(TriangleMesh& mesh, DisjointSets& corners) {
  std::vector<std::uint32_t> sources(mesh.positions.size());
  std::iota(sources.begin(), sources.end(), 0u);
  std::vector<bool> taken(mesh.positions.size(), false);
  std::vector<std::uint32_t> vertex_of(3 * mesh.triangles.size());
  for (std::uint32_t corner = 0; corner < vertex_of.size(); ++corner) {
    const std::uint32_t first = corners.find(corner);
    if (first == corner) {
      const std::uint32_t v = start(mesh, corner);
      vertex_of[corner] = taken[v] ? static_cast<std::uint32_t>(sources.size()) : v;
      if (taken[v]) sources.push_back(v);
      taken[v] = true;
    }
    vertex_of[corner] = vertex_of[first];
  }
  for (std::uint32_t corner = 0; corner < vertex_of.size(); ++corner) {
    mesh.triangles[corner / 3][corner % 3] = vertex_of[corner];
  }
  const std::size_t added = sources.size() - mesh.positions.size();
  if (added == 0) return 0;
  const Selection copies(sources);
  mesh.positions = gather(mesh.positions, copies);
  mesh.attributes = gather(mesh.attributes, copies);
  return added;
}

}  // namespace

const Schema<ManifoldParams>& ManifoldParams::schema() {
  using P = ManifoldParams;
  static const auto schema = Schema<P>().flag(
      "keep_solids", &P::keep_solids,
      "where more than two triangles meet in an edge, those with matter between them stay joined");
  return schema;
}

Facts ManifoldReport::facts() const {
  return {{"degenerate_triangles", static_cast<double>(degenerate_triangles), ""},
          {"duplicate_triangles", static_cast<double>(duplicate_triangles), ""},
          {"singular_edges", static_cast<double>(singular_edges), ""},
          {"flipped_edges", static_cast<double>(flipped_edges), ""},
          {"added_vertices", static_cast<double>(added_vertices), ""}};
}

Result<ManifoldReport> make_manifold(TriangleMesh& mesh, const ManifoldParams& params,
                                     const Context& context) {
  if (auto valid = ManifoldParams::schema().check(params); !valid) return valid.error();
  if (auto sound = check(mesh); !sound) return sound.error();

  ManifoldReport report;
  TriangleMesh result = mesh;
  keep_triangles(result, proper_triangles(mesh, report));
  context.progress(0.2);
  const std::optional<EdgeTable> edges = EdgeTable::of(result, context.part(0.2, 0.5));
  if (!edges) return cancelled();
  Joints joints(result, *edges, params.keep_solids, report);
  DisjointSets corners = joints.corners();
  while (joints.cut_shared(corners)) {
    if (context.cancelled()) return cancelled();
    corners = joints.corners();
  }
  context.progress(0.8);
  if (context.cancelled()) return cancelled();
  report.added_vertices = give_vertices(result, corners);
  std::swap(mesh, result);
  context.progress(1);
  return report;
}

}  // namespace burnish
