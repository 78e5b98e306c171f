#pragma once

#include <span>
#include <vector>

#include "burnish/adaptation/removal.h"
#include "burnish/base/result.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// How the triangles around a vertex lie, and what its removal does to them.
enum class StarShape : std::uint8_t {
  closed,  ///< all around it: the first two triangles go
  open,    ///< from one boundary edge to the other: the first goes
  ear,     ///< one triangle between two boundary edges: it goes; the second, which is beyond its
           ///< third edge, stays as it is
};

/// The triangles that a removal has to do with, by their numbers in the original mesh: those that
/// go, then those that change a corner from one boundary edge to the other or around, then the
/// one beside an ear.
struct Star {
  StarShape shape = StarShape::closed;
  std::span<const std::uint32_t> triangles;
};

/// Makes removals on the triangles of a mesh, one after the other, and refuses those that would not
/// leave the surface what it is.
///
/// The star of the vertex must be a disc: one closed fan of three triangles or more, or one open
/// fan. A vertex of an open fan goes along the boundary only. It and the vertex that it goes into
/// must have no neighbours in common but in triangles with both (the link condition of Dey,
/// Edelsbrunner, Guha and Nekhayev 1999), and no triangle may come to be that is there already.
/// Then the disc is triangulated anew, and all around it stays: the surface that comes is
/// homeomorphic to the one before. What the mesh is elsewhere (non-manifold edges, duplicate and
/// degenerate triangles) does not matter.
class RemovalReplay {
 public:
  /// `mesh` must pass check(); it is not needed afterwards. O(#V + #T).
  explicit RemovalReplay(const TriangleMesh& mesh);

  /// Makes the removal; its star is of meaning until the next call. O(valence of the two vertices).
  /// Errors: bad_geometry that says what stands against it; nothing is changed then.
  Result<Star> apply(const Removal& removal);

 private:
  static constexpr std::uint32_t kNone = ~0u;
  /// The one or two triangles of the star, by their places in `star_`, along an edge to its rim.
  struct Spoke {
    std::uint32_t first = kNone, second = kNone;
  };

  template <class Visit>
  void for_each_triangle(std::uint32_t vertex, Visit visit);
  bool collect_star(std::uint32_t vertex);
  Result<StarShape> order_star(const Removal& removal);
  Result<void> check_link(const Removal& removal, StarShape shape);
  Result<StarShape> find_star(const Removal& removal);
  std::uint32_t corner_beside(std::uint32_t triangle, std::uint32_t a, std::uint32_t b) const;
  void clear_spokes(std::uint32_t vertex);
  void rename(const Removal& removal, StarShape shape);

  std::vector<Triangle> triangles_;  ///< as they are now
  std::vector<bool> gone_;           ///< per triangle
  std::vector<std::uint32_t> first_, last_,
      next_;                   ///< lists of corners (3 * triangle + corner), one a vertex
  std::vector<Spoke> spokes_;  ///< per vertex; of the star at work
  std::vector<std::uint32_t> star_, ordered_;  ///< triangles
};

}  // namespace burnish
