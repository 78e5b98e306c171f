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

/// The weights of Eq. 1; the vertex's own is 0.
class Equation1 {
 public:
  /// `rounding` is the uncertainty of coordinates.
  explicit Equation1(double rounding) : rounding_(rounding) {}

  double operator()(const RingView& ring, std::span<double> weights,
                    std::span<double> distances) const {
    for (std::size_t i = 0; i < distances.size(); ++i) {
      distances[i] = squared_norm(ring.neighbours[i] - ring.centre);
    }
    const auto [least, greatest] = std::minmax_element(distances.begin(), distances.end());
    const bool tied = maybe_tied(distances, *least, *greatest);
    const bool symmetric = tied && point_symmetric(ring, rounding_);
    const Tie nearest(ring, distances, *least, symmetric, rounding_);
    const Tie farthest(ring, distances, *greatest, symmetric, rounding_);
    for (std::size_t i = 0; i < weights.size(); ++i) {
      weights[i] = 1 + nearest.share(i) + farthest.share(i);
    }
    return 0;
  }

  /// The sum of the neighbours, plus the nearest, plus the farthest. Mostly nobody is tied, and
  /// then no weights are needed.
  WeightedSum sum(const Vec3d* positions, std::uint32_t v,
                  std::span<const std::uint32_t> ring) const {
    constexpr std::size_t kShort = 32;
    if (ring.size() > kShort) return weighed(positions, v, ring);
    const Vec3d centre = positions[v];
    Vec3d all;
    double distances[kShort], least = std::numeric_limits<double>::infinity(), greatest = -1;
    std::uint32_t nearest = 0, farthest = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::uint32_t w = ring[i];
      const double distance = squared_norm(positions[w] - centre);
      all += positions[w];
      distances[i] = distance;
      // Who is nearest and farthest cannot be predicted, so no branch may depend on it.
      const bool nearer = distance<least, farther = distance> greatest;
      least = nearer ? distance : least;
      nearest = nearer ? w : nearest;
      greatest = farther ? distance : greatest;
      farthest = farther ? w : farthest;
    }
    if (maybe_tied({distances, ring.size()}, least, greatest)) return weighed(positions, v, ring);
    return {all + positions[nearest] + positions[farthest], static_cast<double>(ring.size() + 2)};
  }

 private:
  /// Whether anybody comes so near to a first place that there may be a tie to settle.
  bool maybe_tied(std::span<const double> distances, double least, double greatest) const {
    // Opposite neighbours differ in distance by at most sqrt(3) times the rounding.
    const auto reach = [this](double extreme) {
      return kTie * extreme + rounding_ * (4 * std::sqrt(extreme) + 4 * rounding_);
    };
    const double near = least + reach(least), far = greatest - reach(greatest);
    int at_first_places = 0;
    for (const double distance : distances)
      at_first_places += (distance <= near) + (distance >= far);
    return at_first_places > 2;
  }

  WeightedSum weighed(const Vec3d* positions, std::uint32_t v,
                      std::span<const std::uint32_t> ring) const {
    return RingWeigher(ring.size()).sum(*this, positions, v, ring);
  }

  double rounding_;
};

/// The pseudo-code as printed: the weights come from the positions before the pass, and then one
/// vertex after the other is moved, which those after it see.
Result<SmoothingReport> smooth_in_place(TriangleMesh& mesh, const RingPasses& passes,
                                        const Context& context, const Equation1& weigh) {
  Result<SweptMesh> work =
      swept_mesh(mesh, passes.boundary, passes.count(), context, passes.layout);
  if (!work) return work.error();
  SigmaFilter sigma(mesh, passes, work->sweep);
  LargeVector<Vec3d>& positions = work->positions;
  RingWeigher weigher(work->sweep.longest_ring());
  for (int pass = 0; pass < passes.count(); ++pass) {
    const LargeVector<Vec3d> before = positions;
    Context share =
        context.part(static_cast<double>(pass) / passes.count(), (pass + 1.0) / passes.count());
    share.threads = 1;
    const auto move = [&](int, const RingTile& tile) {
      tile.for_each([&](std::uint32_t v, std::span<const std::uint32_t> ring) {
        if (ring.empty()) return;
        const WeightedSum weighed = weigher.sum(weigh, before.data(), v, ring);
        Vec3d sum;
        for (std::size_t i = 0; i < ring.size(); ++i) {
          sum += weigher.weights()[i] * positions[ring[i]];
        }
        const double hold = 1 - (1 - passes.damping_of(pass)) * work->follow(v);
        positions[v] = (1 - hold) * (sum / weighed.weight) + hold * positions[v];
        if (sigma.wanted()) {
          sigma.move(pass, v, ring, hold, weigher.weights(), (1 - hold) / weighed.weight);
        }
      });
    };
    if (!work->sweep.run(share, 1, move)) return cancelled();
  }
  Result<SmoothingReport> report =
      commit_positions(mesh, work->sweep, positions, passes.iterations, context);
  if (report) sigma.finish(mesh, passes.count());
  return report;
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
  RingPasses passes{
      .iterations = params.iterations, .boundary = params.boundary, .damping = {params.damping}};
  const Equation1 weigh(kRounding * largest_coordinate(mesh));
  if (params.order == UpdateOrder::jacobi) return filter_rings(mesh, passes, context, weigh);
  passes.layout.numbering = Numbering::as_given;
  return smooth_in_place(mesh, passes, context, weigh);
}

}  // namespace burnish
