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
  const int passes = 2 * params.iterations;
  Result<SweptMesh> work = swept_mesh(mesh, params.boundary, passes, context);
  if (!work) return work.error();
  const RingSweep& sweep = work->sweep;
  LargeVector<Vec3d>& positions = work->positions;
  const LargeVector<Vec3d> first = positions;
  LargeVector<Vec3d> steps(sweep.size()), excess(sweep.size());
  // Even passes find what is too much of the move to the mean, odd ones push back.
  const auto step = [&](int pass, const RingTile& tile) {
    tile.for_each([&](std::uint32_t v, std::span<const std::uint32_t> ring) {
      if (pass % 2 == 0) {
        steps[v] = ring_step(positions.data(), v, ring);
        excess[v] = steps[v] + params.alpha * (positions[v] - first[v]);
      } else if (!ring.empty()) {
        const Vec3d spread = ring_step(excess.data(), v, ring);
        const Vec3d back = excess[v] + (1 - params.beta) * spread;
        positions[v] += work->follow(v) * (steps[v] - back);
      }
    });
  };
  if (!sweep.run(context, passes, step)) return cancelled();
  return commit_positions(mesh, sweep, positions, params.iterations, context);
}

}  // namespace burnish
