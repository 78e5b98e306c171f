#include "burnish/smoothing/ring_filter.h"

#include <cmath>

namespace burnish {

SigmaFilter::SigmaFilter(const TriangleMesh& mesh, const RingPasses& passes, const RingSweep& sweep)
    : sweep_(sweep) {
  const auto& damping = passes.damping;
  const bool averages =
      std::all_of(damping.begin(), damping.end(), [](double d) { return d <= 1; });
  if (!averages || mesh.attributes.sigma.empty()) return;
  std::vector<double>& variance = variance_[0];
  for (const float sigma : sweep.taken_over(mesh.attributes.sigma)) {
    variance.push_back(double{sigma} * double{sigma});
  }
  variance_[1] = variance;
  averaged_.assign(variance.size(), 1);
}

void SigmaFilter::move(int pass, std::size_t v, std::span<const std::uint32_t> neighbours,
                       double own, std::span<const double> weights, double scale) {
  const std::vector<double>& now = variance_[pass % 2];
  double squares = own * own, sum = own * own * now[v];
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    const double square = weights[i] * scale * weights[i] * scale;
    squares += square;
    sum += square * now[neighbours[i]];
  }
  variance_[1 - pass % 2][v] = sum / squares;
  averaged_[v] += 1 / squares - 1;
}

void SigmaFilter::finish(TriangleMesh& mesh, int passes) const {
  if (!wanted()) return;
  const std::vector<double>& variance = variance_[passes % 2];
  for (std::size_t v = 0; v < variance.size(); ++v) {
    mesh.attributes.sigma[sweep_.in_mesh(v)] =
        static_cast<float>(std::sqrt(variance[v] / averaged_[v]));
  }
}

}  // namespace burnish
