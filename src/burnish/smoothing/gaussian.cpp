#include "burnish/smoothing/gaussian.h"

#include <cmath>

#include "burnish/core/edges.h"
#include "burnish/smoothing/ring_filter.h"

namespace burnish {

const Schema<GaussianParams>& GaussianParams::schema() {
  using P = GaussianParams;
  static const auto schema =
      Schema<P>()
          .integer("iterations", &P::iterations, between(0, 100000), "number of passes")
          .real("relative_width", &P::relative_width, {.low = 1e-3, .high = 1e3},
                "standard deviation of the weights in mean edge lengths")
          .choice("boundary", &P::boundary, boundary_rule_names(),
                  "what vertices on an open boundary do");
  return schema;
}

Result<SmoothingReport> smooth_gaussian(TriangleMesh& mesh, const GaussianParams& params,
                                        const Context& context) {
  if (auto valid = GaussianParams::schema().check(params); !valid) return valid.error();
  if (auto sound = check(mesh); !sound) return sound.error();
  const double width = params.relative_width * mean_edge_length(mesh);
  // A mesh whose edges all have length 0 is a point: any weights leave it where it is.
  const double factor = width > 0 ? -1 / (2 * width * width) : 0;
  return filter_rings(
      mesh,
      {.iterations = params.iterations, .boundary = params.boundary, .layout = {.effort = 10}},
      context, [factor](const RingView& ring, std::span<double> weights, std::span<double>) {
        for (std::size_t i = 0; i < weights.size(); ++i) {
          weights[i] = std::exp(factor * squared_norm(ring.neighbours[i] - ring.centre));
        }
        return 1.0;
      });
}

}  // namespace burnish
