#include "burnish/adaptation/midpoint.h"

#include "burnish/adaptation/quadrisection.h"
#include "burnish/base/parallel.h"

namespace burnish {
namespace {

bool run_pass(TriangleMesh& mesh, const RefinementZone& zone, int, const Context& context) {
  const auto plan = plan_quadrisection(mesh, zone, context.part(0, 0.6));
  if (!plan) return false;
  Placement placement(mesh, plan->parents.size());
  const auto place = [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      Blend middle;
      for (const std::uint32_t end : plan->parents[i]) middle.add(mesh, end, 0.5);
      placement.put(mesh.positions.size() + i, middle);
    }
  };
  return parallel_for(context.part(0.6, 0.7), plan->parents.size(), place) &&
         quadrisect(mesh, *plan, std::move(placement), context.part(0.7, 1));
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
