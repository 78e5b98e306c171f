#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "burnish/base/parallel.h"
#include "burnish/core/adjacency.h"
#include "burnish/smoothing/smoothing.h"
#include "burnish/smoothing/smoothing_weights.h"

// What the smoothings that move vertices to weighted means of their one-rings share. Not part of
// the library's interface.
namespace burnish {

/// A vertex and the neighbours that the boundary rule gives it, never none. They are brought
/// together before anything is computed of them: what follows then runs over a few numbers in a
/// row.
struct RingView {
  Vec3d centre;
  std::span<const Vec3d> neighbours;
};

struct RingPasses {
  int iterations = 1;
  BoundaryRule boundary = BoundaryRule::fixed;
  double damping = 0;     ///< the share of each move that is held back
  bool in_place = false;  ///< later vertices see the new positions of earlier ones
};

/// The neighbours that each vertex is smoothed with; none where it is to stay.
Adjacency smoothing_rings(const TriangleMesh& mesh, BoundaryRule boundary);

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

std::vector<Vec3d> in_double(const std::vector<Vec3f>& positions);
std::vector<Vec3f> in_float(const std::vector<Vec3d>& positions);
std::size_t longest_row(const Adjacency& rows);

/// Like parallel_for, but from the first index to the last.
bool for_in_order(const Context& context, std::size_t count,
                  const std::function<void(IndexRange)>& body);

/// Jacobi passes over the one-rings: every vertex moves to the weighted mean of its ring and
/// itself, all of one pass computed from the positions before it, in double from the first pass to
/// the last. `weigh(ring, weights, scratch)` fills one weight per neighbour and returns the
/// vertex's own; their sum must be positive; `scratch` is as long as `weights`. Vertices without
/// neighbours under the boundary rule stay, and smoothing_weights.h holds others back. Normals that
/// are there are computed anew, sigma follows SigmaFilter, all other attributes stay as they are.
/// On error or cancellation `mesh` is unchanged. O(iterations * #T).
template <class Weigh>
Result<SmoothingReport> filter_rings(TriangleMesh& mesh, const RingPasses& passes,
                                     const Context& context, const Weigh& weigh) {
  if (auto sound = check(mesh); !sound) return sound.error();
  const Result<std::vector<float>> follows = smoothing_weights(mesh);
  if (!follows) return follows.error();
  const Adjacency rings = smoothing_rings(mesh, passes.boundary);
  const std::size_t longest = longest_row(rings);
  std::vector<Vec3d> positions = in_double(mesh.positions), next = positions;
  SigmaFilter sigma(mesh.attributes.sigma);
  // The weights always come from the positions before the pass, as in the printed pseudo-code.
  const std::vector<Vec3d>& source = passes.in_place ? next : positions;

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
      const double own = weigh(RingView{positions[v], neighbours}, weights,
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
      const double hold =
          follows->empty() ? passes.damping : 1 - (1 - passes.damping) * (*follows)[v];
      next[v] = (1 - hold) * (sum / total) + hold * source[v];
      if (sigma.wanted()) {
        const double share = (1 - hold) / total;
        sigma.move(v, row, share * own + hold, weights, share);
      }
    }
  };
  // To wake other threads for a few milliseconds of work costs more than they save.
  constexpr double kSmall = 4e6;
  const bool small = static_cast<double>(rings.items().size()) * passes.iterations < kSmall;
  for (int pass = 0; pass < passes.iterations; ++pass) {
    Context share = context.part(static_cast<double>(pass) / passes.iterations,
                                 (pass + 1.0) / passes.iterations);
    if (small) share.threads = 1;
    if (passes.in_place) next = positions;
    const bool complete = passes.in_place ? for_in_order(share, positions.size(), move)
                                          : parallel_for(share, positions.size(), move);
    if (!complete) return cancelled();
    std::swap(positions, next);
    sigma.finish_pass();
  }

  std::vector<Vec3f> moved = in_float(positions);
  std::vector<float> moved_sigma = sigma.take();
  std::swap(mesh.positions, moved);
  mesh.attributes.sigma = std::move(moved_sigma);
  if (!mesh.attributes.normals.empty()) mesh.attributes.normals = vertex_normals(mesh);
  context.progress(1);
  return report_moves(moved, mesh, passes.iterations);
}

}  // namespace burnish
