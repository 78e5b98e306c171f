#pragma once

#include <algorithm>
#include <vector>

#include "burnish/adaptation/half_edges.h"
#include "burnish/adaptation/patch_deviation.h"

namespace burnish {

/// An edge collapse: which end goes, and where the other one is afterwards.
struct Collapse {
  HalfEdges::Index half_edge;
  bool head_goes;
  Vec3f position;
};

/// Per triangle how far it and the part of the original surface that it stands for may be from
/// each other, both ways: zero at first, and carried from the triangles that a collapse changes to
/// those that it leaves, with what it moves the surface there added.
class DeviationBound {
 public:
  /// `limits`: per triangle of the mesh what its bound must not exceed, m. Where triangles become
  /// others these get the least limit among them.
  explicit DeviationBound(std::vector<float> limits)
      : errors_(limits.size(), 0.f), limits_(std::move(limits)) {}

  /// Whether the bounds keep to their limits if `collapse`, which must be possible, is made; if so
  /// they are henceforth those after it. O(valence^2). A
  /// vertex on the boundary may only go along it, and
  /// one that others are merged into at a boundary must stay in its place.
  bool accept(const HalfEdges& half_edges, const LargeVector<Vec3f>& positions,
              const Collapse& collapse);

  /// From now on `limit` (m) is that of every triangle.
  void set_limits(float limit) { std::fill(limits_.begin(), limits_.end(), limit); }

  /// The largest bound so far, m.
  double largest() const { return largest_; }

  /// Triangle t is henceforth what was `kept[t]`.
  void compact(const LargeVector<HalfEdges::Index>& kept);

 private:
  using Index = HalfEdges::Index;

  void take_star(const HalfEdges& half_edges, const LargeVector<Vec3f>& positions, Index v,
                 Index beside);
  std::uint32_t point_of(Index v, const LargeVector<Vec3f>& positions);

  std::vector<float> errors_, limits_;
  double largest_ = 0;
  PatchDeviation patch_;
  std::vector<Index> vertices_, old_triangles_,
      new_triangles_;  ///< of patch_, as the mesh has them
};

}  // namespace burnish
