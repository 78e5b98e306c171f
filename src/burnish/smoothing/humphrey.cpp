#include "burnish/smoothing/humphrey.h"

#include "burnish/smoothing/ring_mesh.h"

namespace burnish {

const Schema<HumphreyParams>& HumphreyParams::schema() {
  using P = HumphreyParams;
  static const auto schema =
      Schema<P>()
          .real("alpha", &P::alpha, between(0, 1), "pull back to the positions at first")
          .real("beta", &P::beta, between(0, 1), "a vertex's own share in the push back")
          .integer("iterations", &P::iterations, between(0, 100000), "number of passes")
          .choice("boundary", &P::boundary, boundary_rule_names(),
                  "what vertices on an open boundary do");
  return schema;
}

Result<SmoothingReport> smooth_humphrey(TriangleMesh& mesh, const HumphreyParams& params,
                                        const Context& context) {
  if (auto valid = HumphreyParams::schema().check(params); !valid) return valid.error();
  Result<RingMesh> work = ring_mesh(mesh, params.boundary);
  if (!work) return work.error();
  std::vector<Vec3d>& positions = work->positions;
  const std::vector<Vec3d> first = positions;
  std::vector<Vec3d> steps(positions.size()), excess = steps, spread = steps;
  for (int pass = 0; pass < params.iterations; ++pass) {
    const Context share = part_of_pass(context, pass, params.iterations, work->rings);
    if (!ring_steps(share.part(0, 0.5), work->rings, positions, steps)) return cancelled();
    for (std::size_t v = 0; v < positions.size(); ++v) {
      excess[v] = steps[v] + params.alpha * (positions[v] - first[v]);
    }
    if (!ring_steps(share.part(0.5, 1), work->rings, excess, spread)) return cancelled();
    for (std::size_t v = 0; v < positions.size(); ++v) {
      if (work->rings.row(v).empty()) continue;
      const Vec3d back = excess[v] + (1 - params.beta) * spread[v];
      positions[v] += work->follow(v) * (steps[v] - back);
    }
  }
  return commit_positions(mesh, positions, params.iterations, context);
}

}  // namespace burnish
