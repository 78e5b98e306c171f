#include "burnish/smoothing/one_ring_mean.h"

#include "burnish/smoothing/ring_filter.h"

namespace burnish {

const Schema<OneRingMeanParams>& OneRingMeanParams::schema() {
  using P = OneRingMeanParams;
  static const auto schema =
      Schema<P>()
          .integer("iterations", &P::iterations, between(0, 100000), "number of passes")
          .choice("boundary", &P::boundary, boundary_rule_names(),
                  "what vertices on an open boundary do");
  return schema;
}

Result<SmoothingReport> smooth_one_ring_mean(TriangleMesh& mesh, const OneRingMeanParams& params,
                                             const Context& context) {
  if (auto valid = OneRingMeanParams::schema().check(params); !valid) return valid.error();
  return filter_rings(mesh, {.iterations = params.iterations, .boundary = params.boundary}, context,
                      EqualWeights{.own = 1});
}

}  // namespace burnish
