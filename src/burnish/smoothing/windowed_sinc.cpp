#include "burnish/smoothing/windowed_sinc.h"

#include <cmath>
#include <numbers>

#include "burnish/smoothing/ring_mesh.h"

namespace burnish {
namespace {

using std::numbers::pi;

/// The factors of the Chebyshev polynomials T_0 to T_degree for the cut-off angle theta.
std::vector<double> factors(int degree, double theta) {
  std::vector<double> result{theta / pi};
  for (int n = 1; n <= degree; ++n) {
    const double window = 0.54 + 0.46 * std::cos(n * pi / (degree + 1));
    result.push_back(window * 2 * std::sin(n * theta) / (n * pi));
  }
  return result;
}

/// By what the filter multiplies waves of frequency k = 2 - 2 cos(angle).
double transfer(const std::vector<double>& factors, double angle) {
  double sum = 0;
  for (std::size_t n = 0; n < factors.size(); ++n) {
    sum += factors[n] * std::cos(static_cast<double>(n) * angle);
  }
  return sum;
}

/// The least angle from that of the pass band on for which the filter leaves the pass band's edge
/// as it is. At pi the filter is the identity.
double cut_off(int degree, double edge) {
  const auto lacks = [&](double theta) { return transfer(factors(degree, theta), edge) < 1; };
  const double step = 0.05 / (degree + 1);  // the transfer oscillates over about pi / degree
  double low = edge;
  while (low + step < pi && lacks(low + step)) low += step;
  double high = std::min(low + step, pi);
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = (low + high) / 2;
    (lacks(middle) ? low : high) = middle;
  }
  return high;
}

std::vector<double> filter(int degree, double pass_band) {
  const double edge = std::acos(1 - pass_band / 2);
  std::vector<double> result = factors(degree, cut_off(degree, edge));
  const double at_rest = transfer(result, 0);
  for (double& factor : result) factor /= at_rest;
  return result;
}

}  // namespace

const Schema<WindowedSincParams>& WindowedSincParams::schema() {
  using P = WindowedSincParams;
  static const auto schema =
      Schema<P>()
          .integer("iterations", &P::iterations, between(0, 10000), "degree of the filter")
          .real("pass_band", &P::pass_band, {.low = 0, .high = 2, .open_low = true},
                "frequency, 0 to 2, up to which all stays")
          .choice("boundary", &P::boundary, boundary_rule_names(),
                  "what vertices on an open boundary do");
  return schema;
}

Result<SmoothingReport> smooth_windowed_sinc(TriangleMesh& mesh, const WindowedSincParams& params,
                                             const Context& context) {
  if (auto valid = WindowedSincParams::schema().check(params); !valid) return valid.error();
  Result<SweptMesh> work = swept_mesh(mesh, params.boundary, params.iterations, context);
  if (!work) return work.error();
  const RingSweep& sweep = work->sweep;
  if (params.iterations == 0) return commit_positions(mesh, sweep, work->positions, 0, context);
  const std::vector<double> factor = filter(params.iterations, params.pass_band);

  // Chebyshev's recurrence with x = I - K / 2: T_1 = x, T_n+1 = 2 x T_n - T_n-1.
  LargeVector<Vec3d>& even = work->positions;
  LargeVector<Vec3d> odd(sweep.size()), filtered(sweep.size());
  const auto step = [&](int pass, const RingTile& tile) {
    const Vec3d* const current = (pass % 2 == 0 ? even : odd).data();
    Vec3d* const other = (pass % 2 == 0 ? odd : even).data();  // T_n-1, which becomes T_n+1
    const double share = factor[static_cast<std::size_t>(pass) + 1];
    tile.for_each([&](std::uint32_t v, std::span<const std::uint32_t> ring) {
      const Vec3d& now = current[v];
      const Vec3d step_now = work->follow(v) * ring_step(current, v, ring);
      const Vec3d next = pass == 0 ? now + step_now / 2 : 2. * now + step_now - other[v];
      if (pass == 0) filtered[v] = ring.empty() ? now : factor[0] * now;
      other[v] = next;
      // Vertices that stay do so to the last bit, which the sum would round.
      if (!ring.empty()) filtered[v] += share * next;
    });
  };
  if (!sweep.run(context, params.iterations, step)) return cancelled();
  return commit_positions(mesh, sweep, filtered, params.iterations, context);
}

}  // namespace burnish
