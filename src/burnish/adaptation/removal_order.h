#pragma once

#include <span>
#include <vector>

#include "burnish/adaptation/removal_replay.h"
#include "burnish/base/context.h"
#include "burnish/core/adjacency.h"

namespace burnish {

/// Which removals of a log rest on which: the multi-triangulation of De Floriani, Magillo and Puppo
/// (1997).
///
/// Two removals whose stars hold the same triangle come in the order of the log; all others may
/// change places. So a set of removals can be made as soon as it holds, with each, all that are
/// below it; and every such set leaves a surface homeomorphic to the original
/// (docs/decisions/multi-triangulation.md says why).
class RemovalOrder {
 public:
  RemovalOrder() = default;

  /// Replays the log on `mesh`, which must pass check(). O(#V + #T + the valences of all vertices
  /// named), about 60 bytes a vertex. Errors: invalid_argument that names the removal, where one
  /// cannot be made, or its error is not a number, negative or less than the one before; cancelled.
  static Result<RemovalOrder> make(const TriangleMesh& mesh, std::span<const Removal> log,
                                   const Context& context = {});

  std::size_t size() const { return shapes_.size(); }
  Star star(std::uint32_t removal) const { return {shapes_[removal], stars_.row(removal)}; }
  /// The removals that must be made before this one, the nearest of them, rising.
  std::span<const std::uint32_t> below(std::uint32_t removal) const { return below_.row(removal); }
  /// Those that cannot be made before this one, the nearest of them, rising.
  std::span<const std::uint32_t> above(std::uint32_t removal) const { return above_.row(removal); }

 private:
  std::vector<StarShape> shapes_;
  Adjacency stars_, below_, above_;
};

/// How many triangles go with a vertex whose star has this shape.
constexpr std::size_t lost_triangles(StarShape shape) {
  return shape == StarShape::closed ? 2 : 1;
}

}  // namespace burnish
