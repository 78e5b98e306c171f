#include "burnish/adaptation/sqrt3.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "burnish/adaptation/blend.h"
#include "burnish/adaptation/interpolation.h"
#include "burnish/base/parallel.h"

namespace burnish {
namespace {

constexpr std::uint32_t kNone = ~0u;

/// What one pass does to the edges and triangles of a mesh.
class Trisection {
 public:
  static std::optional<Trisection> plan(const TriangleMesh& mesh, const RefinementZone& zone,
                                        bool cuts_creases, const Context& context);

  const EdgeTable& edges() const { return edges_; }
  const std::vector<bool>& creases() const { return crease_; }
  /// Of the new vertices: on creases first, each with the nearer end named twice, then inside
  /// triangles.
  const std::vector<Parents<3>>& parents() const { return parents_; }
  std::size_t vertices_on_creases() const { return vertices_on_creases_; }
  bool cut(std::uint32_t edge) const { return edge != kNoEdge && first_cut_[edge] != kNone; }

  /// The new vertex on a cut edge that is nearer to its end `v`.
  std::uint32_t beside(std::uint32_t edge, std::uint32_t v) const {
    return first_cut_[edge] + (edges_.vertices(edge)[0] == v ? 0 : 1);
  }

  std::uint32_t parts(std::size_t t) const { return refined(t) ? 3 : 1; }
  /// Writes the parts of triangle t.
  void write(const TriangleMesh& mesh, std::uint32_t t, Triangle* out) const;

 private:
  explicit Trisection(EdgeTable edges) : edges_(std::move(edges)) {}

  void find_creases(const TriangleMesh& mesh);
  void choose_cuts(const TriangleMesh& mesh, const RefinementZone& zone);
  void number_vertices(const TriangleMesh& mesh);

  bool refined(std::size_t t) const { return refined_[t]; }
  /// The side of triangle t that is cut in three, or 3.
  std::uint32_t cut_side(std::uint32_t t) const {
    std::uint32_t i = 0;
    while (i < 3 && !cut(edges_.of_side(3 * std::size_t{t} + i))) ++i;
    return i;
  }
  /// The new vertex that the part of a triangle along an uncut side has as its third corner.
  std::uint32_t apex(const TriangleMesh& mesh, std::uint32_t side) const;

  EdgeTable edges_;
  std::vector<bool> crease_;              ///< per edge: not to be flipped, whatever is refined
  std::vector<bool> refined_;             ///< per triangle
  std::vector<std::uint32_t> first_cut_;  ///< per edge the first of its two vertices, or kNone
  std::vector<std::uint32_t> centroid_;   ///< per triangle the vertex in it, or kNone
  std::vector<Parents<3>> parents_;
  std::size_t vertices_on_creases_ = 0;
};

void Trisection::find_creases(const TriangleMesh& mesh) {
  const auto start = [&](std::uint32_t side) { return mesh.triangles[side / 3][side % 3]; };
  const auto opposite = [&](std::uint32_t side) { return start(side - side % 3 + (side + 2) % 3); };
  crease_.resize(edges_.size());
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const auto sides = edges_.sides(e);
    crease_[e] = sides.size() != 2 || start(sides[0]) == start(sides[1]) ||
                 opposite(sides[0]) == opposite(sides[1]);
  }
}

/// Creases in the zone are cut, each in all its triangles. A triangle can be cut along one side
/// only: where two want to be, both stay whole.
void Trisection::choose_cuts(const TriangleMesh& mesh, const RefinementZone& zone) {
  const auto only_crease = [&](std::uint32_t side) {
    int creases = 0;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t edge = edges_.of_side(side - side % 3 + i);
      creases += edge == kNoEdge || crease_[edge];
    }
    return creases == 1;
  };
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const auto [a, b] = edges_.vertices(e);
    if (!crease_[e] || !(zone.has(a) || zone.has(b))) continue;
    const auto sides = edges_.sides(e);
    if (!std::all_of(sides.begin(), sides.end(), only_crease)) continue;
    first_cut_[e] = static_cast<std::uint32_t>(mesh.positions.size() + parents_.size());
    parents_.push_back({a, a, b});
    parents_.push_back({a, b, b});
  }
  vertices_on_creases_ = parents_.size();
}

void Trisection::number_vertices(const TriangleMesh& mesh) {
  centroid_.assign(mesh.triangles.size(), kNone);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!refined(t) || cut_side(t) < 3) continue;
    centroid_[t] = static_cast<std::uint32_t>(mesh.positions.size() + parents_.size());
    parents_.push_back(mesh.triangles[t]);
  }
}

std::optional<Trisection> Trisection::plan(const TriangleMesh& mesh, const RefinementZone& zone,
                                           bool cuts_creases, const Context& context) {
  std::optional<EdgeTable> edges = EdgeTable::of(mesh, context);
  if (!edges) return {};
  Trisection plan(*std::move(edges));
  plan.refined_.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    plan.refined_[t] = zone.touches(mesh.triangles[t]);
  }
  plan.find_creases(mesh);
  plan.first_cut_.assign(plan.edges_.size(), kNone);
  if (cuts_creases) plan.choose_cuts(mesh, zone);
  plan.number_vertices(mesh);
  return plan;
}

std::uint32_t Trisection::apex(const TriangleMesh& mesh, std::uint32_t side) const {
  const std::uint32_t t = side / 3, i = side % 3, cut = cut_side(t);
  if (cut == 3) return centroid_[t];
  const Triangle& corners = mesh.triangles[t];
  // The side after the cut one begins where this ends, the side before it ends where this begins.
  const std::uint32_t shared = (cut + 1) % 3 == i ? corners[i] : corners[(i + 1) % 3];
  return beside(edges_.of_side(3 * std::size_t{t} + cut), shared);
}

void Trisection::write(const TriangleMesh& mesh, std::uint32_t t, Triangle* out) const {
  const Triangle& corners = mesh.triangles[t];
  if (!refined(t)) {
    out[0] = corners;
    return;
  }
  for (std::uint32_t i = 0; i < 3; ++i) {
    const std::uint32_t side = 3 * t + i, edge = edges_.of_side(side);
    const std::uint32_t p = corners[i], q = corners[(i + 1) % 3];
    if (cut(edge)) {
      out[i] = {beside(edge, p), beside(edge, q), corners[(i + 2) % 3]};
      continue;
    }
    out[i] = {p, q, apex(mesh, side)};
    if (edge == kNoEdge || crease_[edge]) continue;
    const auto sides = edges_.sides(edge);
    const std::uint32_t other = sides[0] == side ? sides[1] : sides[0];
    if (refined(other / 3)) out[i][1] = apex(mesh, other);
  }
}

/// The weight of all neighbours together of an inner vertex that has so many.
double weight_of_ring(std::uint32_t neighbours) {
  return (4 - 2 * std::cos(2 * std::numbers::pi / neighbours)) / 9;
}

/// Where the old and the new vertices of one pass go.
class Places {
 public:
  Places(const TriangleMesh& mesh, const RefinementZone& zone, const Trisection& plan)
      : mesh_(mesh), zone_(zone), rings_(rings_of(mesh, plan.edges(), plan.creases())) {
    cut_creases_.assign(mesh.positions.size(), 0);
    for (std::uint32_t e = 0; e < plan.edges().size(); ++e) {
      if (!plan.cut(e)) continue;
      for (const std::uint32_t v : plan.edges().vertices(e)) ++cut_creases_[v];
    }
  }

  Blend old_vertex(std::uint32_t v) const {
    const Ring& ring = rings_[v];
    double weight = 0;
    if (on_curve(v)) {
      weight = 8.0 / 27;
    } else if (ring.count > 0 && !ring.crease && zone_.has(v)) {
      weight = weight_of_ring(ring.count);
    }
    Blend blend;
    blend.add(mesh_, v, 1 - weight);
    if (weight > 0) blend.add(ring.sum, weight / ring.count);
    return blend;
  }

  Blend centroid(const Parents<3>& corners) const {
    Blend blend;
    for (const std::uint32_t v : corners) blend.add(mesh_, v, 1);
    blend.position = blend.position / 3.0;
    blend.sigma /= 3;
    return blend;
  }

  /// Of the new vertex on a crease that lies beside the end that is named twice.
  Blend on_crease(const Parents<3>& parents) const {
    const std::uint32_t v = parents[1], w = parents[0] == v ? parents[2] : parents[0];
    if (!on_curve(v)) return centroid(parents);
    Blend blend;  // the ring is w and the neighbour on the other side
    blend.add(rings_[v].sum, 1.0 / 27);
    blend.add(mesh_, v, 16.0 / 27);
    blend.add(mesh_, w, 9.0 / 27);
    return blend;
  }

 private:
  /// Whether v lies on just two creases, and both are cut.
  bool on_curve(std::uint32_t v) const {
    return cut_creases_[v] == 2 && rings_[v].count == 2 && zone_.has(v);
  }

  const TriangleMesh& mesh_;
  const RefinementZone& zone_;
  std::vector<Ring> rings_;
  std::vector<std::uint32_t> cut_creases_;  ///< per vertex
};

std::optional<Placement> place(const TriangleMesh& mesh, const RefinementZone& zone,
                               const Trisection& plan, const Context& context) {
  const Places places(mesh, zone, plan);
  const std::size_t old = mesh.positions.size();
  Placement placement(mesh, plan.parents().size());
  const auto move_old = [&](IndexRange range) {
    for (auto v = static_cast<std::uint32_t>(range.begin); v < range.end; ++v) {
      placement.put(v, places.old_vertex(v));
    }
  };
  const auto put_new = [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const Parents<3>& parents = plan.parents()[i];
      const bool inside = i >= plan.vertices_on_creases();
      placement.put(old + i, inside ? places.centroid(parents) : places.on_crease(parents));
    }
  };
  if (!parallel_for(context.part(0.3, 0.6), old, move_old)) return {};
  if (!parallel_for(context.part(0.6, 1), plan.parents().size(), put_new)) return {};
  return placement;
}

/// Cuts the triangles; false where the context was cancelled.
bool trisect(TriangleMesh& mesh, const Trisection& plan, Placement placement,
             const Context& context) {
  const std::size_t count = mesh.triangles.size();
  std::vector<std::uint32_t> first(count + 1, 0);
  for (std::size_t t = 0; t < count; ++t) first[t + 1] = first[t] + plan.parts(t);
  std::vector<Triangle> triangles(first.back());
  const bool cut = parallel_for(context, count, [&](IndexRange range) {
    for (auto t = static_cast<std::uint32_t>(range.begin); t < range.end; ++t) {
      plan.write(mesh, t, triangles.data() + first[t]);
    }
  });
  if (!cut) return false;
  inherit_attributes(mesh.triangle_attributes, first);
  mesh.triangles = std::move(triangles);
  append_interpolated<3>(mesh.attributes, mesh.positions.size(), plan.parents());
  std::move(placement).apply(mesh);
  return true;
}

bool run_pass(TriangleMesh& mesh, const RefinementZone& zone, int index, const Context& context) {
  const bool cuts_creases = index % 2 == 1;
  const auto plan = Trisection::plan(mesh, zone, cuts_creases, context.part(0, 0.5));
  if (!plan) return false;
  auto placement = place(mesh, zone, *plan, context.part(0.5, 0.75));
  return placement && trisect(mesh, *plan, *std::move(placement), context.part(0.75, 1));
}

}  // namespace

const Schema<Sqrt3Params>& Sqrt3Params::schema() {
  using P = Sqrt3Params;
  static const auto schema = Schema<P>().integer("iterations", &P::iterations, between(0, 20),
                                                 "number of passes, each making three of one");
  return schema;
}

Result<RefinementReport> refine_sqrt3(TriangleMesh& mesh, const Sqrt3Params& params,
                                      const Context& context) {
  if (auto valid = Sqrt3Params::schema().check(params); !valid) return valid.error();
  return refine_in_passes(mesh, {params.iterations, 3, run_pass}, context);
}

}  // namespace burnish
