#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "burnish/smoothing/ring_filter.h"

// How Eq. 1 of Ozbay and Cinar weighs a ring; nearest_farthest.h says it in words. Not part of the
// library's interface.
namespace burnish {

/// The weights of Eq. 1; the vertex's own is 0.
class Equation1 {
 public:
  /// `positions`: those of the mesh, whose largest coordinate says how uncertain all are.
  explicit Equation1(std::span<const Vec3f> positions) {
    float largest = 0;
    for (const Vec3f& p : positions) {
      largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    rounding_ = kRounding * largest;
  }

  /// How uncertain coordinates are, m.
  double rounding() const { return rounding_; }
  static constexpr double kTie = 2e-9;  ///< of a squared distance: 1e-9 of a distance

  double operator()(const RingView& ring, std::span<double> weights,
                    std::span<double> distances) const {
    for (std::size_t i = 0; i < distances.size(); ++i) {
      distances[i] = squared_norm(ring.neighbours[i] - ring.centre);
    }
    const auto [least, greatest] = std::minmax_element(distances.begin(), distances.end());
    settle(ring, distances, *least, *greatest, maybe_tied(distances, *least, *greatest), weights);
    return 0;
  }

  /// The sum of the neighbours, plus the nearest, plus the farthest. Mostly nobody is tied, and
  /// then no weights are needed. Allocates for oddly long rings only.
  WeightedSum sum(const Vec3d* positions, std::uint32_t v,
                  std::span<const std::uint32_t> ring) const {
    if (ring.size() > kShort) return RingWeigher(ring.size()).sum(*this, positions, v, ring);
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
    const std::span<const double> all_distances(distances, ring.size());
    // Depths in whole millimetres bring many near to a first place and next to none into it.
    if (maybe_tied(all_distances, least, greatest) &&
        (shared(all_distances, least) || shared(all_distances, greatest) ||
         maybe_symmetric(positions, v, ring, nearest, farthest))) {
      return tied_sum(positions, v, ring, all_distances, least, greatest);
    }
    return {all + positions[nearest] + positions[farthest], static_cast<double>(ring.size() + 2)};
  }

 private:
  static constexpr double kRounding = 1e-6;  ///< of the largest coordinate: some roundings to float
  static constexpr std::size_t kShort = 16;
  static constexpr std::size_t kBits = 64;

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

  /// Whether more than one is at the distance `extreme`.
  static bool shared(std::span<const double> distances, double extreme) {
    int count = 0;
    for (const double distance : distances) count += equal(distance, extreme);
    return count > 1;
  }
  static bool equal(double distance, double extreme) {
    return std::abs(distance - extreme) <= kTie * extreme;
  }

  /// Whether the vertex lies in the middle between neighbours a and b as far as float coordinates,
  /// which are uncertain by `rounding_`, can say.
  bool opposite(const Vec3d& a, const Vec3d& b, const Vec3d& vertex) const {
    // Mostly the first coordinate says no.
    return std::abs(a.x + b.x - 2 * vertex.x) <= rounding_ &&
           std::abs(a.y + b.y - 2 * vertex.y) <= rounding_ &&
           std::abs(a.z + b.z - 2 * vertex.z) <= rounding_;
  }
  bool opposite(const RingView& ring, std::size_t i, std::size_t k) const {
    return opposite(ring.neighbours[i], ring.neighbours[k], ring.centre);
  }

  /// Whether the nearest and the farthest neighbour at least have one opposite to them.
  bool maybe_symmetric(const Vec3d* positions, std::uint32_t v, std::span<const std::uint32_t> ring,
                       std::uint32_t nearest, std::uint32_t farthest) const {
    const auto has_opposite = [&](std::uint32_t u) {
      return std::any_of(ring.begin(), ring.end(), [&](std::uint32_t w) {
        return opposite(positions[u], positions[w], positions[v]);
      });
    };
    return has_opposite(farthest) && has_opposite(nearest);
  }

  /// Whether every neighbour has another one opposite to it.
  bool point_symmetric(const RingView& ring) const {
    const std::size_t count = ring.neighbours.size();
    // In grids, whose vertices are counted row by row, the first is opposite to the last.
    bool mirrored = count % 2 == 0;
    for (std::size_t i = 0; mirrored && i < count / 2; ++i) {
      mirrored = opposite(ring, i, count - 1 - i);
    }
    if (mirrored) return true;
    for (std::size_t i = 0; i < count; ++i) {
      std::size_t k = 0;
      while (k < count && (k == i || !opposite(ring, i, k))) ++k;
      if (k == count) return false;
    }
    return true;
  }

  /// Shares a weight of 1 out among the neighbours that stand for the nearest (or the farthest):
  /// those at the distance `extreme`, and in a point-symmetric ring those opposite to them. All
  /// distances are squared.
  void share_out(const RingView& ring, std::span<const double> distances, double extreme,
                 bool symmetric, std::span<double> weights) const {
    const std::size_t count = distances.size();
    std::uint64_t equals = 0;  // who of the first neighbours is at that distance
    for (std::size_t i = 0; i < std::min(count, kBits); ++i) {
      equals |= std::uint64_t{equal(distances[i], extreme)} << i;
    }
    const auto stands_for_it = [&](std::size_t i) {
      if (equal(distances[i], extreme)) return true;
      if (!symmetric) return false;
      for (std::uint64_t left = equals; left != 0; left &= left - 1) {
        if (opposite(ring, i, static_cast<std::size_t>(std::countr_zero(left)))) return true;
      }
      for (std::size_t k = kBits; k < count; ++k) {
        if (equal(distances[k], extreme) && opposite(ring, i, k)) return true;
      }
      return false;
    };
    std::uint64_t first = 0;  // who of them does, to ask but once
    for (std::size_t i = 0; i < std::min(count, kBits); ++i) {
      first |= std::uint64_t{stands_for_it(i)} << i;
    }
    const auto does = [&](std::size_t i) {
      return i < kBits ? (first >> i & 1) != 0 : stands_for_it(i);
    };
    auto all = static_cast<std::size_t>(std::popcount(first));
    for (std::size_t i = kBits; i < count; ++i) all += does(i);
    const double share = 1 / static_cast<double>(all);
    for (std::size_t i = 0; i < count; ++i) weights[i] += does(i) ? share : 0;
  }

  /// The weights, where `maybe_tied` says how it is.
  void settle(const RingView& ring, std::span<const double> distances, double least,
              double greatest, bool maybe_tied, std::span<double> weights) const {
    const bool symmetric = maybe_tied && point_symmetric(ring);
    std::fill(weights.begin(), weights.end(), 1.0);
    share_out(ring, distances, least, symmetric, weights);
    share_out(ring, distances, greatest, symmetric, weights);
  }

  /// `sum` where there may be a tie; of short rings.
  WeightedSum tied_sum(const Vec3d* positions, std::uint32_t v, std::span<const std::uint32_t> ring,
                       std::span<const double> distances, double least, double greatest) const {
    std::array<Vec3d, kShort> neighbours;
    std::array<double, kShort> weights;
    for (std::size_t i = 0; i < ring.size(); ++i) neighbours[i] = positions[ring[i]];
    settle({v, positions[v], ring, {neighbours.data(), ring.size()}}, distances, least, greatest,
           true, {weights.data(), ring.size()});
    WeightedSum result{0. * positions[v], 0};
    for (std::size_t i = 0; i < ring.size(); ++i) {
      result.weight += weights[i];
      result.sum += weights[i] * neighbours[i];
    }
    return result;
  }

  double rounding_;  ///< the uncertainty of coordinates
};

}  // namespace burnish
