#pragma once

#include <span>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/core/adjacency.h"
#include "burnish/smoothing/face_geometry.h"

// What the normals of a mesh's faces may be, filtered in several ways. Not part of the library's
// interface.
namespace burnish {

/// Several filtered normals of each face, a face's in a row.
struct NormalCandidates {
  static constexpr std::size_t kCount = 9;
  /// Their places in a row.
  static constexpr std::size_t kRaw = 0, kOnce = 1, kTwice = 2, kFourTimes = 3, kEightTimes = 4,
                               kNarrow = 6;

  std::vector<Quad> normals;  ///< #T * kCount

  std::size_t faces() const { return normals.size() / kCount; }
  std::span<const Quad> of(std::size_t face) const {
    return {normals.data() + face * kCount, kCount};
  }
};

/// The face's own normal; the mean of its surroundings, weighted by area and distance, after 1, 2,
/// 4 and 8 passes; and the same with weights that fall with the angle between normals (Zheng, Fu,
/// Au, Tai 2011), narrow and wide, each after three and eight passes. `around`: vertex_neighbours.
/// Returns false where cancelled. O(#T).
[[nodiscard]] bool normal_candidates(const FaceGeometry& faces, const Adjacency& around,
                                     const Context& context, NormalCandidates& candidates);

}  // namespace burnish
