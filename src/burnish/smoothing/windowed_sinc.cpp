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
  Result<RingMesh> work = ring_mesh(mesh, params.boundary);
  if (!work) return work.error();
  if (params.iterations == 0) return commit_positions(mesh, work->positions, 0, context);
  const std::vector<double> factor = filter(params.iterations, params.pass_band);

  // Chebyshev's recurrence with x = I - K / 2: T_1 = x, T_n+1 = 2 x T_n - T_n-1.
  std::vector<Vec3d> previous = work->positions, current = previous, filtered = previous;
  std::vector<Vec3d> steps(current.size());
  for (Vec3d& p : filtered) p *= factor[0];
  for (int n = 1; n <= params.iterations; ++n) {
    const Context share = part_of_pass(context, n - 1, params.iterations, work->rings);
    if (!ring_steps(share, work->rings, current, steps)) return cancelled();
    for (std::size_t v = 0; v < current.size(); ++v) {
      const Vec3d step = work->follow(v) * steps[v];
      const Vec3d next = n == 1 ? current[v] + step / 2 : 2. * current[v] + step - previous[v];
      previous[v] = current[v];
      current[v] = next;
      filtered[v] += factor[static_cast<std::size_t>(n)] * next;
    }
  }
  for (std::size_t v = 0; v < filtered.size(); ++v) {
    // These stay to the last bit, which the sum above would round.
    if (work->rings.row(v).empty()) filtered[v] = work->positions[v];
  }
  return commit_positions(mesh, filtered, params.iterations, context);
}

}  // namespace burnish
