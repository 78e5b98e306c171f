#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "burnish/smoothing/ring_filter.h"

// How Eq. 1 of Ozbay and Cinar weighs a ring; nearest_farthest.h says it in words. Not part of the
// library's interface.
namespace burnish {

namespace equation1_detail {

inline constexpr double kTie = 2e-9;  ///< of a squared distance: 1e-9 of a distance
inline constexpr double kRounding =
    1e-6;  ///< of the largest coordinate: about 16 roundings to float

/// Whether the vertex lies in the middle between neighbours i and k as far as float coordinates,
/// which are uncertain by `rounding`, can say.
inline bool opposite(const RingView& ring, double rounding, std::size_t i, std::size_t k) {
  const Vec3d offset = ring.neighbours[i] + ring.neighbours[k] - 2. * ring.centre;
  return std::max({std::abs(offset.x), std::abs(offset.y), std::abs(offset.z)}) <= rounding;
}

/// Whether every neighbour has another one opposite to it.
inline bool point_symmetric(const RingView& ring, double rounding) {
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

}  // namespace equation1_detail

/// The weights of Eq. 1; the vertex's own is 0.
class Equation1 {
 public:
  /// `positions`: those of the mesh, whose largest coordinate says how uncertain all are.
  explicit Equation1(std::span<const Vec3f> positions) {
    float largest = 0;
    for (const Vec3f& p : positions) {
      largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    rounding_ = equation1_detail::kRounding * largest;
  }

  double operator()(const RingView& ring, std::span<double> weights,
                    std::span<double> distances) const {
    using namespace equation1_detail;
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
    using namespace equation1_detail;
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
  double rounding_;  ///< the uncertainty of coordinates
};

}  // namespace burnish
