#include "burnish/smoothing/nearest_farthest.h"

#include <algorithm>
#include <cmath>

#include "burnish/smoothing/ring_filter.h"

namespace burnish {
namespace {

constexpr double kTie = 2e-9;  ///< of a squared distance: 1e-9 of a distance
constexpr double kNearlyEqual =
    0.01;                           ///< of a squared distance: beyond it rounding decides nothing
constexpr double kOpposite = 1e-6;  ///< of a coordinate: about 16 roundings to float

/// Whether p lies in the middle between a and b as far as float coordinates can say.
bool opposite(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const auto size = [](const Vec3d& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  };
  return size(a + b - 2. * p) <= kOpposite * std::max({size(p), size(a), size(b)});
}

/// Which neighbours stand for the nearest (or the farthest), given all squared distances.
class Tie {
 public:
  Tie(const RingView& ring, std::span<const double> distances, double extreme)
      : ring_(ring), distances_(distances), extreme_(extreme) {
    for (std::size_t i = 0; i < distances.size(); ++i) count_ += has(i);
  }

  bool has(std::size_t i) const {
    if (equal(i)) return true;
    if (std::abs(distances_[i] - extreme_) > kNearlyEqual * extreme_) return false;
    for (std::size_t k = 0; k < distances_.size(); ++k) {
      if (equal(k) && opposite(ring_.centre(), ring_.neighbour(i), ring_.neighbour(k))) return true;
    }
    return false;
  }
  double share(std::size_t i) const { return has(i) ? 1 / static_cast<double>(count_) : 0; }

 private:
  bool equal(std::size_t i) const { return std::abs(distances_[i] - extreme_) <= kTie * extreme_; }

  const RingView& ring_;
  std::span<const double> distances_;
  double extreme_;
  std::size_t count_ = 0;
};

/// The weights of Eq. 1; the vertex's own is 0.
double weigh(const RingView& ring, std::span<double> weights, std::span<double> distances) {
  for (std::size_t i = 0; i < weights.size(); ++i) {
    distances[i] = squared_norm(ring.neighbour(i) - ring.centre());
  }
  const auto [least, greatest] = std::minmax_element(distances.begin(), distances.end());
  const Tie nearest(ring, distances, *least), farthest(ring, distances, *greatest);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    weights[i] = 1 + nearest.share(i) + farthest.share(i);
  }
  return 0;
}

}  // namespace

const Schema<NearestFarthestParams>& NearestFarthestParams::schema() {
  using P = NearestFarthestParams;
  static const auto schema =
      Schema<P>()
          .integer("iterations", &P::iterations, between(0, 100000), "number of passes")
          .real("damping", &P::damping, {.low = 0, .high = 1, .open_high = true},
                "share of each move that is held back")
          .choice("boundary", &P::boundary, boundary_rule_names(),
                  "what vertices on an open boundary do")
          .choice("order", &P::order,
                  {{"jacobi", UpdateOrder::jacobi}, {"in_place", UpdateOrder::in_place}},
                  "which positions a vertex is moved with");
  return schema;
}

Result<SmoothingReport> smooth_nearest_farthest(TriangleMesh& mesh,
                                                const NearestFarthestParams& params,
                                                const Context& context) {
  if (auto valid = NearestFarthestParams::schema().check(params); !valid) return valid.error();
  return filter_rings(mesh,
                      {.iterations = params.iterations,
                       .boundary = params.boundary,
                       .damping = params.damping,
                       .in_place = params.order == UpdateOrder::in_place},
                      context, weigh);
}

}  // namespace burnish
