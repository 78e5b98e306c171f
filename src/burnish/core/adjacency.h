#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "burnish/base/large_vector.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// Lists of indices in compressed rows: row(i) is the list of element i. Immutable once built.
class Adjacency {
 public:
  Adjacency() = default;
  /// `offsets` has one entry more than there are rows, rising from 0 to `items.size()`.
  Adjacency(LargeVector<std::uint32_t> offsets, LargeVector<std::uint32_t> items)
      : offsets_(std::move(offsets)), items_(std::move(items)) {}

  std::size_t size() const { return offsets_.empty() ? 0 : offsets_.size() - 1; }
  std::span<const std::uint32_t> row(std::size_t i) const {
    return {items_.data() + offsets_[i], items_.data() + offsets_[i + 1]};
  }
  const LargeVector<std::uint32_t>& offsets() const { return offsets_; }
  const LargeVector<std::uint32_t>& items() const { return items_; }

 private:
  LargeVector<std::uint32_t> offsets_, items_;
};

/// Per vertex the triangles that use it, rising. A triangle that names a vertex twice is listed
/// once. O(#V + #T).
Adjacency triangles_of_vertices(const TriangleMesh& mesh);

/// Which neighbours are listed of a vertex that lies on an edge without exactly two triangles (a
/// boundary or a non-manifold edge).
enum class BoundaryRings {
  none,
  along_boundary,  ///< those along such edges
  all,
};

/// Per vertex the distinct vertices joined to it by an edge, rising, itself left out. O(#V + #T).
Adjacency one_rings(const TriangleMesh& mesh, BoundaryRings at_boundary = BoundaryRings::all);

/// Per vertex whether it lies on an edge that does not have exactly two triangles (a boundary or
/// a non-manifold edge); such vertices are what the boundary rules of smoothing speak of.
std::vector<bool> boundary_vertices(const TriangleMesh& mesh);

/// Per vertex its neighbours along such edges only, rising.
Adjacency boundary_neighbours(const TriangleMesh& mesh);

}  // namespace burnish
