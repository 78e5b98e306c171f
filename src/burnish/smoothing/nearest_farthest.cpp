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

/// The first and the last of some distances, all of them squared, and the places next to these.
class Extremes {
 public:
  /// Who is nearest and farthest cannot be predicted, so no branch may depend on it.
  void add(double distance, std::uint32_t who) {
    const bool nearer = distance<least_, farther = distance> greatest_;
    second_least_ = std::min(second_least_, std::max(distance, least_));
    second_greatest_ = std::max(second_greatest_, std::min(distance, greatest_));
    least_ = nearer ? distance : least_;
    nearest_ = nearer ? who : nearest_;
    greatest_ = farther ? distance : greatest_;
    farthest_ = farther ? who : farthest_;
  }

  double least() const { return least_; }
  double greatest() const { return greatest_; }
  std::uint32_t nearest() const { return nearest_; }
  std::uint32_t farthest() const { return farthest_; }

  /// Whether anybody comes so near to a first place that there may be a tie to settle.
  bool maybe_tied(double rounding) const {
    // Opposite neighbours differ in distance by at most sqrt(3) times the rounding.
    const auto reach = [rounding](double extreme) {
      return kTie * extreme + rounding * (4 * std::sqrt(extreme) + 4 * rounding);
    };
    return second_least_ <= least_ + reach(least_) ||
           second_greatest_ >= greatest_ - reach(greatest_);
  }

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  double least_ = kFar, second_least_ = kFar, greatest_ = -1, second_greatest_ = -1;
  std::uint32_t nearest_ = 0, farthest_ = 0;
};

/// The weights of Eq. 1; the vertex's own is 0.
class Equation1 {
 public:
  /// `rounding` is the uncertainty of coordinates.
  explicit Equation1(double rounding) : rounding_(rounding) {}

  double operator()(const RingView& ring, std::span<double> weights,
                    std::span<double> distances) const {
    Extremes extremes;
    for (std::uint32_t i = 0; i < weights.size(); ++i) {
      distances[i] = squared_norm(ring.neighbours[i] - ring.centre);
      extremes.add(distances[i], i);
      weights[i] = 1;
    }
    if (!extremes.maybe_tied(rounding_)) {
      weights[extremes.nearest()] += 1;
      weights[extremes.farthest()] += 1;
      return 0;
    }
    const bool symmetric = point_symmetric(ring, rounding_);
    const Tie nearest(ring, distances, extremes.least(), symmetric, rounding_);
    const Tie farthest(ring, distances, extremes.greatest(), symmetric, rounding_);
    for (std::size_t i = 0; i < weights.size(); ++i) {
      weights[i] = 1 + nearest.share(i) + farthest.share(i);
    }
    return 0;
  }

  /// Mostly nobody is tied, and then no weights are needed.
  WeightedSum sum(const Vec3d* positions, std::uint32_t v,
                  std::span<const std::uint32_t> ring) const {
    const Vec3d centre = positions[v];
    Vec3d all;
    Extremes extremes;
    for (const std::uint32_t w : ring) {
      extremes.add(squared_norm(positions[w] - centre), w);
      all += positions[w];
    }
    if (extremes.maybe_tied(rounding_)) {
      return RingWeigher(ring.size()).sum(*this, positions, v, ring);
    }
    return {all + positions[extremes.nearest()] + positions[extremes.farthest()],
            static_cast<double>(ring.size() + 2)};
  }

 private:
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
