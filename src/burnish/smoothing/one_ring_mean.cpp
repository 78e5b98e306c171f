#include "burnish/smoothing/one_ring_mean.h"

#include "burnish/smoothing/ring_filter.h"

namespace burnish {

const Schema<OneRingMeanParams>& OneRingMeanParams::schema() {
  using P = OneRingMeanParams;
  static const auto schema = Schema<P>()
      .integer("iterations", &P::iterations, between(0, 100000), "number of passes")
      .choice("boundary", &P::boundary,
              {{"fixed", BoundaryRule::fixed},
               {"along_boundary", BoundaryRule::along_boundary},
               {"free", BoundaryRule::free}},
              "what vertices on an open boundary do");
  return schema;
}

Result<SmoothingReport> smooth_one_ring_mean(TriangleMesh& mesh, const OneRingMeanParams& params,
                                             const Context& context) {
  if (auto valid = OneRingMeanParams::schema().check(params); !valid) return valid.error();
  return filter_rings(mesh, params.iterations, params.boundary, context,
                      [](std::uint32_t v, auto ring, auto positions) {
                        Vec3d sum(positions[v]);
                        for (const std::uint32_t w : ring) sum += Vec3d(positions[w]);
                        return sum / static_cast<double>(ring.size() + 1);
                      });
}

}  // namespace burnish
