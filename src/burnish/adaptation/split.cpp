#include "burnish/adaptation/split.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>

#include "burnish/adaptation/closed_pair.h"
#include "burnish/adaptation/normal_arc.h"
#include "burnish/adaptation/splittable_mesh.h"
#include "burnish/core/edges.h"

namespace burnish {
namespace {

/// What edges may be like, m; infinite where there is no limit.
struct Limits {
  double length = HUGE_VAL, chord = HUGE_VAL;

  bool curved() const { return chord < HUGE_VAL; }
  /// No edge that is not longer than this is ever split: an arc rises by at most an eighth.
  double shortest() const { return std::min(length, 8 * chord); }
};

Limits limits_of(const TriangleMesh& mesh, const SplitParams& params) {
  Limits limits;
  if (params.target_edge_length > 0) limits.length = params.target_edge_length;
  if (params.max_chord > 0) limits.chord = params.max_chord;
  if (!limits.curved() && params.target_edge_length == 0) {
    const double mean = mean_edge_length(mesh);
    if (mean > 0) limits.length = mean;
  }
  return limits;
}

/// Every split makes edges shorter, by 0.9 % at least where arcs rise most, so that splitting ends
/// - if the rounding of places to floats is as little. Errors: invalid_argument.
Result<void> check_limits(const TriangleMesh& mesh, const Limits& limits) {
  double farthest = 0, area = 0;
  for (const Vec3f& p : mesh.positions) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      farthest = std::max<double>(farthest, std::abs(p[axis]));
    }
  }
  const double least = std::ldexp(farthest, limits.curved() ? -16 : -20);
  if (limits.shortest() < least) {
    return Error{ErrorCode::invalid_argument,
                 fmt::format("edges of {} m cannot be told apart at coordinates of {} m: {} m "
                             "can{}",
                             limits.shortest(), farthest, least,
                             limits.curved() ? " (of eight times max_chord)" : ""),
                 {}};
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) area += norm(area_vector(mesh, t)) / 2;
  const double largest_triangle = std::sqrt(3.0) / 4 * limits.length * limits.length;
  return check_refined_size(area / largest_triangle / 2, area / largest_triangle);
}

std::vector<Vec3d> normals_of(const TriangleMesh& mesh) {
  const std::vector<Vec3f> of_triangles = vertex_normals(mesh);
  std::vector<Vec3d> normals(of_triangles.begin(), of_triangles.end());
  for (std::size_t v = 0; v < mesh.attributes.normals.size(); ++v) {
    const Vec3d own(mesh.attributes.normals[v]);
    if (squared_norm(own) > 0) normals[v] = normalized(own);
  }
  return normals;
}

class Splitter {
 public:
  Splitter(const TriangleMesh& mesh, const EdgeTable& edges, const RefinementZone& zone,
           const Limits& limits)
      : surface_(mesh, edges), limits_(limits) {
    if (limits.curved()) normals_ = normals_of(mesh);
    in_zone_.resize(mesh.positions.size());
    for (std::uint32_t v = 0; v < in_zone_.size(); ++v) in_zone_[v] = zone.has(v);
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
      if (!in_closed_pair(edges, e)) consider(e);
    }
  }

  /// Errors: invalid_argument where there are too many triangles, cancelled.
  Result<void> run(const Context& context) {
    const double longest = queue_.empty() ? 0 : queue_.top().squared_length;
    const double shortest = limits_.shortest() * limits_.shortest();
    double done = 0;
    for (std::size_t splits = 0; !queue_.empty(); ++splits) {
      const auto [length, edge] = queue_.top();
      if (splits % 1024 == 0) {
        // Of a surface there are as many triangles as its edges' squared length gets smaller.
        if (length > shortest && longest > shortest) {
          done = std::max(done, (longest / length - 1) / (longest / shortest - 1));
        }
        context.progress(done);
        if (context.cancelled()) return cancelled();
        const auto possible = check_refined_size(static_cast<double>(surface_.positions().size()),
                                                 static_cast<double>(surface_.triangles().size()));
        if (!possible) return possible;
      }
      const std::uint32_t longer = first_to_split(edge);
      if (longer == edge) queue_.pop();
      split(longer);
    }
    return {};
  }

  const SplittableMesh& surface() const { return surface_; }

 private:
  struct Candidate {
    double squared_length;
    std::uint32_t edge;
    friend bool operator<(const Candidate& a, const Candidate& b) {
      return a.squared_length != b.squared_length ? a.squared_length < b.squared_length
                                                  : a.edge > b.edge;
    }
  };

  bool in_zone(std::uint32_t edge) const {
    const auto [a, b] = surface_.ends(edge);
    return in_zone_[a] || in_zone_[b];
  }

  NormalArc arc(std::uint32_t edge) const {
    const auto [a, b] = surface_.ends(edge);
    const auto& places = surface_.positions();
    return {Vec3d(places[b]) - Vec3d(places[a]), normals_[a], normals_[b]};
  }

  void consider(std::uint32_t edge) {
    if (!in_zone(edge)) return;
    const double length = surface_.squared_length(edge);
    const bool bent = limits_.curved() && norm(arc(edge).rise) > limits_.chord;
    if (bent || length > limits_.length * limits_.length) queue_.push({length, edge});
  }

  /// The edge at the end of ever longer ones in each other's triangles.
  std::uint32_t first_to_split(std::uint32_t edge) const {
    for (;;) {
      const std::uint32_t longer = surface_.longest_beside(edge);
      if (longer == edge) return edge;
      edge = longer;
    }
  }

  void split(std::uint32_t edge) {
    const auto [a, b] = surface_.ends(edge);
    const auto& places = surface_.positions();
    Vec3d place = 0.5 * (Vec3d(places[a]) + Vec3d(places[b]));
    if (limits_.curved()) {
      const NormalArc between = arc(edge);
      if (in_zone(edge)) place += between.rise;
      normals_.push_back(between.normal);
    }
    in_zone_.push_back(in_zone_[a] && in_zone_[b]);
    for (const std::uint32_t changed : surface_.split(edge, Vec3f(place))) consider(changed);
  }

  SplittableMesh surface_;
  Limits limits_;
  std::vector<Vec3d> normals_;  ///< of the vertices, where arcs matter
  std::vector<bool> in_zone_;   ///< per vertex
  std::priority_queue<Candidate> queue_;
};

/// `mesh` with the vertices and triangles of `surface`, which was made from it.
TriangleMesh assembled(const TriangleMesh& mesh, const SplittableMesh& surface) {
  TriangleMesh result = mesh;
  result.triangle_attributes.origin = gather(mesh.triangle_attributes.origin, surface.origins());
  result.triangle_attributes.owner = gather(mesh.triangle_attributes.owner, surface.origins());
  append_interpolated<2>(result.attributes, mesh.positions.size(), surface.parents());
  result.positions = surface.positions();
  result.triangles = surface.triangles();
  if (!result.attributes.normals.empty() && !surface.parents().empty()) {
    result.attributes.normals = vertex_normals(result);
  }
  return result;
}

}  // namespace

const Schema<SplitParams>& SplitParams::schema() {
  using P = SplitParams;
  static const auto schema =
      Schema<P>()
          .real("target_edge_length", &P::target_edge_length, at_least(0),
                "edges longer than this are split; 0: none are, or those longer than the mean "
                "where max_chord is 0 too",
                Quantity::length)
          .real("max_chord", &P::max_chord, at_least(0),
                "edges are split where the arc that normals suggest is farther away than this, and "
                "new vertices lie on the arc; 0: none are",
                Quantity::length);
  return schema;
}

Result<RefinementReport> refine_split(TriangleMesh& mesh, const SplitParams& params,
                                      const Context& context) {
  if (auto valid = SplitParams::schema().check(params); !valid) return valid.error();
  if (auto sound = check(mesh); !sound) return sound.error();
  const auto zone = RefinementZone::of(mesh);
  if (!zone) return zone.error();
  const Limits limits = limits_of(mesh, params);
  if (auto possible = check_limits(mesh, limits); !possible) return possible.error();

  const auto edges = EdgeTable::of(mesh, context.part(0, 0.2));
  if (!edges) return cancelled();
  Splitter splitter(mesh, *edges, *zone, limits);
  if (auto done = splitter.run(context.part(0.2, 0.9)); !done) return done.error();
  TriangleMesh result = assembled(mesh, splitter.surface());
  context.progress(0.95);
  if (context.cancelled()) return cancelled();
  const RefinementReport report = report_refinement(mesh, result);
  std::swap(mesh, result);
  context.progress(1);
  return report;
}

}  // namespace burnish
