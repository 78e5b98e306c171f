#include "burnish/adaptation/loop.h"

#include <cmath>
#include <numbers>

#include "burnish/adaptation/blend.h"
#include "burnish/adaptation/quadrisection.h"
#include "burnish/base/parallel.h"

namespace burnish {
namespace {

/// The third corner of the triangle that `side` belongs to.
std::uint32_t opposite(const TriangleMesh& mesh, std::uint32_t side) {
  return mesh.triangles[side / 3][(side + 2) % 3];
}

/// Where the surface does not go on from one triangle to another.
std::vector<bool> creases_of(const EdgeTable& edges) {
  std::vector<bool> crease(edges.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto sides = edges.sides(e);
    crease[e] = sides.size() != 2 || sides[0] / 3 == sides[1] / 3;
  }
  return crease;
}

/// The weight of all neighbours together of an inner vertex that has so many.
double weight_of_ring(std::uint32_t neighbours) {
  const double part = 3.0 / 8 + std::cos(2 * std::numbers::pi / neighbours) / 4;
  return 5.0 / 8 - part * part;
}

Blend old_vertex(const TriangleMesh& mesh, std::uint32_t v, const Ring& ring) {
  Blend blend;
  if (ring.count == 0 || (ring.crease && ring.count != 2)) {
    blend.add(mesh, v, 1);
    return blend;
  }
  const double weight = ring.crease ? 1.0 / 4 : weight_of_ring(ring.count);
  blend.add(mesh, v, 1 - weight);
  blend.add(ring.sum, weight / ring.count);
  return blend;
}

Blend new_vertex(const TriangleMesh& mesh, const EdgeTable& edges, std::size_t edge,
                 bool in_middle) {
  Blend blend;
  for (const std::uint32_t end : edges.vertices(edge)) {
    blend.add(mesh, end, in_middle ? 1.0 / 2 : 3.0 / 8);
  }
  if (in_middle) return blend;
  for (const std::uint32_t side : edges.sides(edge)) blend.add(mesh, opposite(mesh, side), 1.0 / 8);
  return blend;
}

/// Where all vertices go; nothing where the context was cancelled.
std::optional<Placement> place(const TriangleMesh& mesh, const RefinementZone& zone,
                               const Quadrisection& plan, const Context& context) {
  const std::vector<bool> crease = creases_of(plan.edges);
  const std::vector<Ring> rings = rings_of(mesh, plan.edges, crease);
  Placement placement(mesh, plan.parents.size());
  const auto move_old = [&](IndexRange range) {
    for (auto v = static_cast<std::uint32_t>(range.begin); v < range.end; ++v) {
      if (zone.has(v)) placement.put(v, old_vertex(mesh, v, rings[v]));
    }
  };
  const auto put_new = [&](IndexRange range) {
    for (std::size_t e = range.begin; e < range.end; ++e) {
      if (plan.vertex_of_edge[e] == kNoVertex) continue;
      const auto [a, b] = plan.edges.vertices(e);
      const bool in_middle = crease[e] || !(zone.has(a) || zone.has(b));
      placement.put(plan.vertex_of_edge[e], new_vertex(mesh, plan.edges, e, in_middle));
    }
  };
  if (!parallel_for(context.part(0.3, 0.6), mesh.positions.size(), move_old)) return {};
  if (!parallel_for(context.part(0.6, 1), plan.edges.size(), put_new)) return {};
  return placement;
}

bool run_pass(TriangleMesh& mesh, const RefinementZone& zone, int, const Context& context) {
  const auto plan = plan_quadrisection(mesh, zone, context.part(0, 0.5));
  if (!plan) return false;
  auto placement = place(mesh, zone, *plan, context.part(0.5, 0.75));
  return placement && quadrisect(mesh, *plan, *std::move(placement), context.part(0.75, 1));
}

}  // namespace

const Schema<LoopParams>& LoopParams::schema() {
  using P = LoopParams;
  static const auto schema = Schema<P>().integer("iterations", &P::iterations, between(0, 16),
                                                 "number of passes, each making four of one");
  return schema;
}

Result<RefinementReport> refine_loop(TriangleMesh& mesh, const LoopParams& params,
                                     const Context& context) {
  if (auto valid = LoopParams::schema().check(params); !valid) return valid.error();
  return refine_in_passes(mesh, {params.iterations, 4, run_pass}, context);
}

}  // namespace burnish
