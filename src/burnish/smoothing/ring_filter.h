#pragma once

#include <algorithm>
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
  std::span<const std::uint32_t> ids;  ///< who the neighbours are, rising
  std::span<const Vec3d> neighbours;   ///< where they are
};

/// Weighs all neighbours alike.
struct EqualWeights {
  double own = 0;  ///< the vertex's own weight

  double operator()(const RingView&, std::span<double> weights, std::span<double>) const {
    std::fill(weights.begin(), weights.end(), 1.0);
    return own;
  }
};

struct RingPasses {
  int iterations = 1;
  BoundaryRule boundary = BoundaryRule::fixed;
  /// The share of each move that is held back. One iteration makes one pass for each of these: 0
  /// goes all the way to the mean, 0.5 half of it, and above 1 it is away from the mean.
  std::vector<double> damping{0};
  bool in_place = false;  ///< later vertices see the new positions of earlier ones
};

/// How sigma follows. One pass over independent errors gives sigma'^2 = sum w_j^2 sigma_j^2. From
/// the second pass on the errors of neighbours are correlated, and the same formula would promise
/// far too much. The variance of m passes of a symmetric filter is the probability that a random
/// walk is back after 2 m steps, which on a surface falls like 1 / m: the number of independent
/// errors that a vertex averages grows by about the same amount, 1 / sum w^2 - 1, in each pass.
/// That is what is added up here. It is exact for one pass and on the safe side after several.
class SigmaFilter {
 public:
  explicit SigmaFilter(const std::vector<float>& sigma);
  bool wanted() const { return !variance_.empty(); }

  /// Vertex v became `own` times itself plus scale * weights[i] times each of its neighbours; these
  /// factors add to 1.
  void move(std::size_t v, std::span<const std::uint32_t> neighbours, double own,
            std::span<const double> weights, double scale);
  void finish_pass();
  std::vector<float> take() const;

 private:
  std::vector<double> variance_, next_;  ///< of one of the errors that are averaged, m^2
  std::vector<double> averaged_;         ///< how many independent errors are averaged
};

/// Like parallel_for, but from the first index to the last.
bool for_in_order(const Context& context, std::size_t count,
                  const std::function<void(IndexRange)>& body);

/// Jacobi passes over the one-rings: every vertex moves to the weighted mean of its ring and
/// itself, all of one pass computed from the positions before it, in double from the first
/// pass to the last. `weigh(ring, weights, scratch)` fills one weight per neighbour and returns the
/// vertex's own; their sum must be positive; `scratch` is as long as `weights`. Vertices without
/// neighbours under the boundary rule stay, and smoothing_weights.h holds others back. Normals that
/// are there are computed anew, all other attributes stay as they are but sigma: it follows
/// SigmaFilter where all moves are towards the mean. Where one is not, what one pass averages the
/// next undoes in part, and SigmaFilter would promise far too much: sigma stays, which is on the
/// safe side of every filter that amplifies nothing. On error or cancellation `mesh` is unchanged.
/// O(iterations * #T).
template <class Weigh>
Result<SmoothingReport> filter_rings(TriangleMesh& mesh, const RingPasses& passes,
                                     const Context& context, const Weigh& weigh) {
  Result<RingMesh> work = ring_mesh(mesh, passes.boundary);
  if (!work) return work.error();
  const Adjacency& rings = work->rings;
  const std::size_t longest = longest_row(rings);
  std::vector<Vec3d>& positions = work->positions;
  std::vector<Vec3d> next = positions;
  const bool averages = *std::max_element(passes.damping.begin(), passes.damping.end()) <= 1;
  SigmaFilter sigma(averages ? mesh.attributes.sigma : std::vector<float>{});
  // The weights always come from the positions before the pass, as in the printed pseudo-code.
  const std::vector<Vec3d>& source = passes.in_place ? next : positions;
  double damping = 0;

  const auto move = [&](IndexRange range) {
    std::vector<double> buffer(2 * longest);
    std::vector<Vec3d> ring(longest);
    for (std::size_t v = range.begin; v < range.end; ++v) {
      const auto row = rings.row(v);
      if (row.empty()) {
        next[v] = positions[v];
        continue;
      }
      for (std::size_t i = 0; i < row.size(); ++i) ring[i] = positions[row[i]];
      const std::span<const Vec3d> neighbours(ring.data(), row.size());
      const std::span<double> weights(buffer.data(), row.size());
      const double own =
          weigh(RingView{static_cast<std::uint32_t>(v), positions[v], row, neighbours}, weights,
                std::span<double>(buffer.data() + longest, row.size()));
      double total = own;
      Vec3d sum = own * source[v];
      if (passes.in_place) {
        for (std::size_t i = 0; i < row.size(); ++i) ring[i] = source[row[i]];
      }
      for (std::size_t i = 0; i < row.size(); ++i) {
        total += weights[i];
        sum += weights[i] * ring[i];
      }
      const double hold = work->follows.empty() ? damping : 1 - (1 - damping) * work->follow(v);
      next[v] = (1 - hold) * (sum / total) + hold * source[v];
      if (sigma.wanted()) {
        const double share = (1 - hold) / total;
        sigma.move(v, row, share * own + hold, weights, share);
      }
    }
  };
  const int count = passes.iterations * static_cast<int>(passes.damping.size());
  for (int pass = 0; pass < count; ++pass) {
    damping = passes.damping[static_cast<std::size_t>(pass) % passes.damping.size()];
    const Context share = part_of_pass(context, pass, count, rings);
    if (passes.in_place) next = positions;
    const bool complete = passes.in_place ? for_in_order(share, positions.size(), move)
                                          : parallel_for(share, positions.size(), move);
    if (!complete) return cancelled();
    std::swap(positions, next);
    sigma.finish_pass();
  }

  std::vector<float> moved_sigma = sigma.wanted() ? sigma.take() : mesh.attributes.sigma;
  Result<SmoothingReport> report = commit_positions(mesh, positions, passes.iterations, context);
  if (report) mesh.attributes.sigma = std::move(moved_sigma);
  return report;
}

}  // namespace burnish
