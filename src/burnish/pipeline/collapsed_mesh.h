#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "burnish/adaptation/removal.h"
#include "burnish/base/context.h"
#include "burnish/base/result.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// What a log of removals leaves of a mesh, and what each of them did.
struct CollapsedMesh {
  static constexpr std::uint32_t kNone = ~0u;

  /// What one removal did, in numbers of the original.
  struct Step {
    std::uint32_t moved_end = 0;  ///< its corners that moved are in `moved` up to here, from where
                                  ///< those of the step before end
    std::array<std::uint32_t, 2> gone{kNone, kNone};  ///< the triangles that went, lowest first
  };

  std::vector<Triangle> triangles;  ///< of the original, where the removals left them
  std::vector<std::uint8_t> vertex_gone, triangle_gone;  ///< 1: removed
  std::vector<Step> steps;                               ///< #removals
  std::vector<std::uint32_t> moved;                      ///< corners, 3 * triangle + place
};

/// Makes the removals, the first one first. Errors: invalid_argument with the first that cannot be
/// made (RemovalReplay) or whose error is no number, negative or less than the one before;
/// cancelled. O(sum of the valences).
Result<CollapsedMesh> collapse(const TriangleMesh& mesh, std::span<const Removal> removals,
                               const Context& context);

}  // namespace burnish
