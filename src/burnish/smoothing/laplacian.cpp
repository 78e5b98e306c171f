#include "burnish/smoothing/laplacian.h"

#include <algorithm>

#include "burnish/smoothing/cotangent.h"
#include "burnish/smoothing/ring_filter.h"

namespace burnish {
namespace {

/// Weighs neighbours by the cotangents of the angles opposite to the edges to them.
class CotangentWeights {
 public:
  CotangentWeights(const TriangleMesh& mesh, BoundaryRule boundary)
      : triangles_(mesh.triangles), fans_(triangles_of_vertices(mesh)) {
    if (boundary == BoundaryRule::along_boundary) on_curve_ = boundary_vertices(mesh);
  }

  double operator()(const RingView& ring, std::span<double> weights, std::span<double>) const {
    if (!on_curve_.empty() && on_curve_[ring.vertex]) {
      std::fill(weights.begin(), weights.end(), 1.0);
      return 0;
    }
    std::fill(weights.begin(), weights.end(), 0.0);
    for (const std::uint32_t t : fans_.row(ring.vertex)) {
      const auto [a, b, c] = triangles_[t];
      if (a == b || b == c || c == a) continue;
      const bool first = a == ring.vertex, second = b == ring.vertex;
      const std::size_t i = slot(ring, first ? b : second ? c : a);
      const std::size_t k = slot(ring, first ? c : second ? a : b);
      const Vec3d &p = ring.neighbours[i], &q = ring.neighbours[k];
      weights[i] += cotangent(q, p, ring.centre);
      weights[k] += cotangent(p, q, ring.centre);
    }
    double sum = 0;
    for (double& weight : weights) sum += weight = std::max(weight, 0.0);
    return sum > 0 ? 0 : 1;
  }

 private:
  static std::size_t slot(const RingView& ring, std::uint32_t id) {
    return static_cast<std::size_t>(std::find(ring.ids.begin(), ring.ids.end(), id) -
                                    ring.ids.begin());
  }

  std::span<const Triangle> triangles_;
  Adjacency fans_;
  std::vector<bool> on_curve_;  ///< vertices that are smoothed along the boundary; empty: none
};

}  // namespace

const Schema<LaplacianParams>& LaplacianParams::schema() {
  using P = LaplacianParams;
  static const auto schema =
      Schema<P>()
          .choice(
              "weights", &P::weights,
              {{"uniform", LaplacianWeights::uniform}, {"cotangent", LaplacianWeights::cotangent}},
              "how neighbours are weighed")
          .real("lambda", &P::lambda, {.low = 0, .high = 1, .open_low = true},
                "share of the way to the mean that one pass goes")
          .integer("iterations", &P::iterations, between(0, 100000), "number of passes")
          .choice("boundary", &P::boundary, boundary_rule_names(),
                  "what vertices on an open boundary do");
  return schema;
}

Result<SmoothingReport> smooth_laplacian(TriangleMesh& mesh, const LaplacianParams& params,
                                         const Context& context) {
  if (auto valid = LaplacianParams::schema().check(params); !valid) return valid.error();
  RingPasses passes{
      .iterations = params.iterations, .boundary = params.boundary, .damping = {1 - params.lambda}};
  if (params.weights == LaplacianWeights::uniform) {
    return filter_rings(mesh, passes, context, EqualWeights{});
  }
  if (auto sound = check(mesh); !sound) return sound.error();
  // The fans of triangles keep their vertices' numbers.
  passes.layout = {.numbering = Numbering::as_given, .effort = 20};
  return filter_rings(mesh, passes, context, CotangentWeights(mesh, params.boundary));
}

}  // namespace burnish
