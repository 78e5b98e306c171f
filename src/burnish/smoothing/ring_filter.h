#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "burnish/smoothing/ring_mesh.h"

// What the smoothings that move vertices to weighted means of their one-rings share. Not part of
// the library's interface.
namespace burnish {

/// A vertex and the neighbours that the boundary rule gives it, never none. They are brought
/// together before anything is computed of them: what follows then runs over a few numbers in a
/// row.
struct RingView {
  std::uint32_t vertex;
  Vec3d centre;
  std::span<const std::uint32_t> ids;  ///< who the neighbours are
  std::span<const Vec3d> neighbours;   ///< where they are
};

/// A sum of positions and of the weights that they were multiplied by.
struct WeightedSum {
  Vec3d sum;
  double weight = 0;
};

/// How the neighbours of a vertex are weighed: `weigh(ring, weights, scratch)` fills one weight per
/// neighbour and returns the vertex's own; their sum must be positive; `scratch` is as long as
/// `weights`.
template <class Weigh>
concept RingWeights = requires(const Weigh weigh, RingView ring, std::span<double> numbers) {
  { weigh(ring, numbers, numbers) } -> std::same_as<double>;
};

/// Weights that have a shorter way to what they are for: the weighted sum of the ring and the
/// vertex itself, up to rounding.
template <class Weigh>
concept DirectRingWeights = RingWeights<Weigh> &&
    requires(const Weigh weigh, const Vec3d* positions, std::span<const std::uint32_t> ring) {
  { weigh.sum(positions, std::uint32_t{}, ring) } -> std::same_as<WeightedSum>;
};

/// Weighs all neighbours alike.
struct EqualWeights {
  double own = 0;  ///< the vertex's own weight

  double operator()(const RingView&, std::span<double> weights, std::span<double>) const {
    std::fill(weights.begin(), weights.end(), 1.0);
    return own;
  }
  WeightedSum sum(const Vec3d* positions, std::uint32_t v,
                  std::span<const std::uint32_t> ring) const {
    Vec3d sum = own * positions[v];
    for (const std::uint32_t w : ring) sum += positions[w];
    return {sum, own + static_cast<double>(ring.size())};
  }
};

/// Weighs the rings of one tile after the other, in memory that is made once.
class RingWeigher {
 public:
  explicit RingWeigher(std::size_t longest_ring)
      : numbers_(2 * longest_ring), ring_(longest_ring) {}

  /// Weighs and adds up; `weights()` and `own()` then say how.
  template <RingWeights Weigh>
  WeightedSum sum(const Weigh& weigh, const Vec3d* positions, std::uint32_t v,
                  std::span<const std::uint32_t> ring) {
    const std::size_t count = ring.size();
    for (std::size_t i = 0; i < count; ++i) ring_[i] = positions[ring[i]];
    weights_ = {numbers_.data(), count};
    own_ = weigh(RingView{v, positions[v], ring, {ring_.data(), count}}, weights_,
                 std::span<double>(numbers_.data() + numbers_.size() / 2, count));
    WeightedSum result{own_ * positions[v], own_};
    for (std::size_t i = 0; i < count; ++i) {
      result.weight += weights_[i];
      result.sum += weights_[i] * ring_[i];
    }
    return result;
  }
  std::span<const double> weights() const { return weights_; }
  double own() const { return own_; }

 private:
  std::vector<double> numbers_;
  std::vector<Vec3d> ring_;
  std::span<double> weights_;
  double own_ = 0;
};

struct RingPasses {
  int iterations = 1;
  BoundaryRule boundary = BoundaryRule::fixed;
  /// The share of each move that is held back. One iteration makes one pass for each of these: 0
  /// goes all the way to the mean, 0.5 half of it, and above 1 it is away from the mean.
  std::vector<double> damping{0};
  /// Weights that know vertices by their numbers ask for these as given.
  SweepLayout layout{};

  int count() const { return iterations * static_cast<int>(damping.size()); }
  double damping_of(int pass) const {
    return damping[static_cast<std::size_t>(pass) % damping.size()];
  }
};

/// How sigma follows. One pass over independent errors gives sigma'^2 = sum w_j^2 sigma_j^2. From
/// the second pass on the errors of neighbours are correlated, and the same formula would promise
/// far too much. The variance of m passes of a symmetric filter is the probability that a random
/// walk is back after 2 m steps, which on a surface falls like 1 / m: the number of independent
/// errors that a vertex averages grows by about the same amount, 1 / sum w^2 - 1, in each pass.
/// That is what is added up here. It is exact for one pass and on the safe side after several.
///
/// Passes that average nothing but move away from the mean undo in part what others average, and
/// the sum would promise far too much: sigma then stays, which is on the safe side of every filter
/// that amplifies nothing.
class SigmaFilter {
 public:
  /// Vertices are numbered as in `sweep`.
  SigmaFilter(const TriangleMesh& mesh, const RingPasses& passes, const RingSweep& sweep);
  bool wanted() const { return !averaged_.empty(); }

  /// In this pass vertex v became `own` times itself plus scale * weights[i] times each of its
  /// neighbours; these factors add to 1.
  void move(int pass, std::size_t v, std::span<const std::uint32_t> neighbours, double own,
            std::span<const double> weights, double scale);

  /// Gives the mesh what came of it after so many passes.
  void finish(TriangleMesh& mesh, int passes) const;

 private:
  const RingSweep& sweep_;
  /// Before passes that are even and odd: the variance of one of the errors that are averaged, m^2.
  /// Vertices that never move have the same in both.
  std::array<std::vector<double>, 2> variance_;
  std::vector<double> averaged_;  ///< how many independent errors are averaged
};

/// Jacobi passes over the one-rings: every vertex moves to the weighted mean of its ring and
/// itself, all of one pass computed from the positions before it, in double from the first
/// pass to the last. Vertices without neighbours under the boundary rule stay, and
/// smoothing_weights.h holds others back. Normals that are there are computed anew, sigma follows
/// SigmaFilter, all other attributes stay as they are. On error or cancellation `mesh` is
/// unchanged. O(iterations * #T).
template <RingWeights Weigh>
Result<SmoothingReport> filter_rings(TriangleMesh& mesh, const RingPasses& passes,
                                     const Context& context, const Weigh& weigh) {
  Result<SweptMesh> work =
      swept_mesh(mesh, passes.boundary, passes.count(), context, passes.layout);
  if (!work) return work.error();
  const RingSweep& sweep = work->sweep;
  SigmaFilter sigma(mesh, passes, sweep);
  LargeVector<Vec3d> other(sweep.size());

  const auto move = [&](int pass, const RingTile& tile) {
    const bool even = pass % 2 == 0;
    const Vec3d* const now = (even ? work->positions : other).data();
    Vec3d* const next = (even ? other : work->positions).data();
    const double damping = passes.damping_of(pass);
    const float* const follows = work->follows.empty() ? nullptr : work->follows.data();
    const bool with_sigma = sigma.wanted();
    RingWeigher weigher(sweep.longest_ring());
    tile.for_each([&, now, next, damping, follows, with_sigma](
                      std::uint32_t v, std::span<const std::uint32_t> ring) {
      if (ring.empty()) {
        next[v] = now[v];
        return;
      }
      WeightedSum all, weighed;
      constexpr bool kDirect = DirectRingWeights<Weigh>;
      if (!kDirect || with_sigma) all = weighed = weigher.sum(weigh, now, v, ring);
      if constexpr (kDirect) all = weigh.sum(now, v, ring);
      const double hold = follows ? 1 - (1 - damping) * double{follows[v]} : damping;
      next[v] = (1 - hold) * (all.sum / all.weight) + hold * now[v];
      if (with_sigma) {
        const double share = (1 - hold) / weighed.weight;
        sigma.move(pass, v, ring, share * weigher.own() + hold, weigher.weights(), share);
      }
    });
  };
  if (!sweep.run(context, passes.count(), move)) return cancelled();

  const bool back = passes.count() % 2 == 0;
  Result<SmoothingReport> report =
      commit_positions(mesh, sweep, back ? work->positions : other, passes.iterations, context);
  if (report) sigma.finish(mesh, passes.count());
  return report;
}

}  // namespace burnish
