#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/large_vector.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// No edge: where a triangle names a vertex twice in a row.
inline constexpr std::uint32_t kNoEdge = ~0u;

/// The edges of a mesh, numbered by (smaller, larger) vertex index, and which sides of triangles
/// lie along them. Side 3 * t + i of a mesh runs from corner i of triangle t to the next one.
/// Immutable once built.
class EdgeTable {
 public:
  /// O(#V + #T log valence). At most 2^32 / 3 triangles. Nothing where the context was cancelled.
  static std::optional<EdgeTable> of(const TriangleMesh& mesh, const Context& context = {});

  std::size_t size() const { return vertices_.size(); }
  /// The smaller index first.
  std::array<std::uint32_t, 2> vertices(std::size_t edge) const { return vertices_[edge]; }
  /// Rising; two for an edge inside a surface, one on its boundary.
  std::span<const std::uint32_t> sides(std::size_t edge) const {
    return {sides_.data() + first_side_[edge], sides_.data() + first_side_[edge + 1]};
  }
  std::uint32_t of_side(std::size_t side) const { return of_side_[side]; }

 private:
  LargeVector<std::array<std::uint32_t, 2>> vertices_;
  LargeVector<std::uint32_t> first_side_, sides_, of_side_;
};

}  // namespace burnish
