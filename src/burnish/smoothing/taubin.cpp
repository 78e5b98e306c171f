#include "burnish/smoothing/taubin.h"

#include "burnish/smoothing/ring_filter.h"

namespace burnish {

const Schema<TaubinParams>& TaubinParams::schema() {
  using P = TaubinParams;
  static const auto schema =
      Schema<P>()
          .real("lambda", &P::lambda, {.low = 0, .high = 1, .open_low = true},
                "step towards the mean of the one-ring")
          .real("mu", &P::mu, {.low = -2, .high = 0, .open_high = true}, "step back")
          .real("pass_band", &P::pass_band, {.low = 0, .high = 1, .open_high = true},
                "frequency 1/lambda + 1/mu that stays as it is, in place of mu; 0: as mu says")
          .integer("iterations", &P::iterations, between(0, 100000), "number of pairs of passes")
          .choice("boundary", &P::boundary, boundary_rule_names(),
                  "what vertices on an open boundary do");
  return schema;
}

Result<SmoothingReport> smooth_taubin(TriangleMesh& mesh, const TaubinParams& params,
                                      const Context& context) {
  if (auto valid = TaubinParams::schema().check(params); !valid) return valid.error();
  const double mu = params.pass_band > 0 ? 1 / (params.pass_band - 1 / params.lambda) : params.mu;
  return filter_rings(mesh,
                      {.iterations = params.iterations,
                       .boundary = params.boundary,
                       .damping = {1 - params.lambda, 1 - mu}},
                      context, EqualWeights{});
}

}  // namespace burnish
