#include "burnish/smoothing/nearest_farthest.h"

#include "burnish/smoothing/equation1.h"
#include "burnish/smoothing/ring_filter.h"

namespace burnish {
namespace {

/// The pseudo-code as printed: the weights come from the positions before the pass, and then one
/// vertex after the other is moved, which those after it see.
Result<SmoothingReport> smooth_in_place(TriangleMesh& mesh, const RingPasses& passes,
                                        const Context& context, const Equation1& weigh) {
  Result<SweptMesh> work =
      swept_mesh(mesh, passes.boundary, passes.count(), context, passes.layout);
  if (!work) return work.error();
  SigmaFilter sigma(mesh, passes, work->sweep);
  LargeVector<Vec3d>& positions = work->positions;
  RingWeigher weigher(work->sweep.longest_ring());
  for (int pass = 0; pass < passes.count(); ++pass) {
    const LargeVector<Vec3d> before = positions;
    Context share =
        context.part(static_cast<double>(pass) / passes.count(), (pass + 1.0) / passes.count());
    share.threads = 1;
    const auto move = [&](int, const RingTile& tile) {
      tile.for_each([&](std::uint32_t v, std::span<const std::uint32_t> ring) {
        if (ring.empty()) return;
        const WeightedSum weighed = weigher.sum(weigh, before.data(), v, ring);
        Vec3d sum;
        for (std::size_t i = 0; i < ring.size(); ++i) {
          sum += weigher.weights()[i] * positions[ring[i]];
        }
        const double hold = 1 - (1 - passes.damping_of(pass)) * work->follow(v);
        positions[v] = (1 - hold) * (sum / weighed.weight) + hold * positions[v];
        if (sigma.wanted()) {
          sigma.move(pass, v, ring, hold, weigher.weights(), (1 - hold) / weighed.weight);
        }
      });
    };
    if (!work->sweep.run(share, 1, move)) return cancelled();
  }
  Result<SmoothingReport> report =
      commit_positions(mesh, work->sweep, positions, passes.iterations, context);
  if (report) sigma.finish(mesh, passes.count());
  return report;
}

}  // namespace

const Schema<NearestFarthestParams>& NearestFarthestParams::schema() {
  using P = NearestFarthestParams;
  static const auto schema =
      Schema<P>()
          .integer("iterations", &P::iterations, between(0, 100000), "number of passes")
          .real("damping", &P::damping, {.low = 0, .high = 1, .open_high = true},
                "share of each move that is held back")
          .choice("boundary", &P::boundary, boundary_rule_names(),
                  "what vertices on an open boundary do")
          .choice("order", &P::order,
                  {{"jacobi", UpdateOrder::jacobi}, {"in_place", UpdateOrder::in_place}},
                  "which positions a vertex is moved with");
  return schema;
}

Result<SmoothingReport> smooth_nearest_farthest(TriangleMesh& mesh,
                                                const NearestFarthestParams& params,
                                                const Context& context) {
  if (auto valid = NearestFarthestParams::schema().check(params); !valid) return valid.error();
  RingPasses passes{
      .iterations = params.iterations, .boundary = params.boundary, .damping = {params.damping}};
  const Equation1 weigh(mesh.positions);
  if (params.order == UpdateOrder::jacobi) return filter_rings(mesh, passes, context, weigh);
  passes.layout.numbering = Numbering::as_given;
  return smooth_in_place(mesh, passes, context, weigh);
}

}  // namespace burnish
