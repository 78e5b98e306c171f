#include "burnish/adaptation/midpoint.h"

#include "burnish/adaptation/quadrisection.h"
#include "burnish/base/parallel.h"

namespace burnish {
namespace {

bool run_pass(TriangleMesh& mesh, const RefinementZone& zone, int, const Context& context) {
  const auto plan = plan_quadrisection(mesh, zone, context.part(0, 0.6));
  if (!plan) return false;
  const std::size_t old = mesh.positions.size();
  std::vector<Vec3f> positions = mesh.positions;
  positions.resize(old + plan->parents.size());
  const auto place = [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const auto [a, b] = plan->parents[i];
      positions[old + i] = midpoint(mesh.positions[a], mesh.positions[b]);
    }
  };
  return parallel_for(context.part(0.6, 0.7), plan->parents.size(), place) &&
         quadrisect(mesh, *plan, std::move(positions), context.part(0.7, 1));
}

}  // namespace

const Schema<MidpointParams>& MidpointParams::schema() {
  using P = MidpointParams;
  static const auto schema = Schema<P>().integer("iterations", &P::iterations, between(0, 16),
                                                 "number of passes, each making four of one");
  return schema;
}

Result<RefinementReport> refine_midpoint(TriangleMesh& mesh, const MidpointParams& params,
                                         const Context& context) {
  if (auto valid = MidpointParams::schema().check(params); !valid) return valid.error();
  return refine_in_passes(mesh, {params.iterations, 4, run_pass}, context);
}

}  // namespace burnish
