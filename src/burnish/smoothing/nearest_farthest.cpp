#include "burnish/smoothing/nearest_farthest.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "burnish/smoothing/ring_filter.h"

namespace burnish {
namespace {

constexpr double kTie = 2e-9;       ///< of a squared distance: 1e-9 of a distance
constexpr double kRounding = 1e-6;  ///< of the largest coordinate: about 16 roundings to float

/// Whether the vertex lies in the middle between neighbours i and k as far as float coordinates,
/// which are uncertain by `rounding`, can say.
bool opposite(const RingView& ring, double rounding, std::size_t i, std::size_t k) {
  const Vec3d offset = ring.neighbours[i] + ring.neighbours[k] - 2. * ring.centre;
  return std::max({std::abs(offset.x), std::abs(offset.y), std::abs(offset.z)}) <= rounding;
}

/// Whether every neighbour has another one opposite to it.
bool point_symmetric(const RingView& ring, double rounding) {
  const std::size_t count = ring.neighbours.size();
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t k = 0;
    while (k < count && (k == i || !opposite(ring, rounding, i, k))) ++k;
    if (k == count) return false;
  }
  return true;
}

/// Which neighbours stand for the nearest (or the farthest): those at the distance `extreme`, and
/// in a point-symmetric ring those opposite to them. All distances are squared.
class Tie {
 public:
  Tie(const RingView& ring, std::span<const double> distances, double extreme, bool symmetric,
      double rounding)
      : ring_(ring),
        distances_(distances),
        extreme_(extreme),
        symmetric_(symmetric),
        rounding_(rounding) {
    for (std::size_t i = 0; i < distances.size(); ++i) count_ += has(i);
  }

  double share(std::size_t i) const { return has(i) ? 1 / static_cast<double>(count_) : 0; }

 private:
  bool has(std::size_t i) const {
    if (equal(i)) return true;
    for (std::size_t k = 0; symmetric_ && k < distances_.size(); ++k) {
      if (equal(k) && opposite(ring_, rounding_, i, k)) return true;
    }
    return false;
  }
  bool equal(std::size_t i) const { return std::abs(distances_[i] - extreme_) <= kTie * extreme_; }

  const RingView& ring_;
  std::span<const double> distances_;
  double extreme_;
  bool symmetric_;
  double rounding_;
  std::size_t count_ = 0;
};

/// The weights of Eq. 1; the vertex's own is 0. `rounding` is the uncertainty of coordinates.
double weigh(const RingView& ring, double rounding, std::span<double> weights,
             std::span<double> distances) {
  double least = std::numeric_limits<double>::infinity(), greatest = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    distances[i] = squared_norm(ring.neighbours[i] - ring.centre);
    least = std::min(least, distances[i]);
    greatest = std::max(greatest, distances[i]);
  }
  // Opposite neighbours differ in distance by at most sqrt(3) times the rounding. Mostly nobody
  // comes that near to the first place, and then there is no tie to settle.
  const auto reach = [rounding](double extreme) {
    return kTie * extreme + rounding * (4 * std::sqrt(extreme) + 4 * rounding);
  };
  const double near = least + reach(least), far = greatest - reach(greatest);
  // Who is nearest and farthest cannot be predicted, so no branch may depend on it.
  int near_count = 0, far_count = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const int is_near = distances[i] <= near, is_far = distances[i] >= far;
    near_count += is_near;
    far_count += is_far;
    weights[i] = static_cast<double>(1 + is_near + is_far);
  }
  if (near_count > 1 || far_count > 1) {
    const bool symmetric = near_count > 1 && far_count > 1 && point_symmetric(ring, rounding);
    const Tie nearest(ring, distances, least, symmetric, rounding);
    const Tie farthest(ring, distances, greatest, symmetric, rounding);
    for (std::size_t i = 0; i < weights.size(); ++i) {
      weights[i] = 1 + nearest.share(i) + farthest.share(i);
    }
  }
  return 0;
}

double largest_coordinate(const TriangleMesh& mesh) {
  float largest = 0;
  for (const Vec3f& p : mesh.positions) {
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  return largest;
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
  const double rounding = kRounding * largest_coordinate(mesh);
  return filter_rings(
      mesh,
      {.iterations = params.iterations,
       .boundary = params.boundary,
       .damping = {params.damping},
       .in_place = params.order == UpdateOrder::in_place},
      context,
      [rounding](const RingView& ring, std::span<double> weights, std::span<double> distances) {
        return weigh(ring, rounding, weights, distances);
      });
}

}  // namespace burnish
