#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/vec3.h"
#include "burnish/spatial/neighbour_grid.h"

namespace burnish {

/// How a point's fan is built.
struct FanRule {
  std::size_t most_neighbours = 96;
  double cos_sheet_angle = 0;  ///< neighbours whose normals are further apart are on another sheet
};

/// Fans of triangles around points, each on its own: the rim of a point is the sequence of
/// neighbours, counter-clockwise around its normal, of which every two in a row make a triangle
/// with it; the last is followed by the first. kGap in a rim stands where no triangle is.
class Fans {
 public:
  static constexpr std::uint32_t kGap = std::numeric_limits<std::uint32_t>::max();

  std::size_t size() const { return offsets_.empty() ? 0 : offsets_.size() - 1; }
  std::span<const std::uint32_t> rim(std::size_t p) const {
    return {rims_.data() + offsets_[p], rims_.data() + offsets_[p + 1]};
  }

  /// Median length of the edges from a point to its rim, but at most twice the largest such length
  /// of a point of the rim, m; 0 where the rim is empty.
  double spacing(std::size_t p) const { return spacing_[p]; }

  /// What follows the neighbour `q` on the rim of `p`, or comes before it; kGap where nothing does.
  std::uint32_t after(std::uint32_t p, std::uint32_t q) const {
    const auto around = rim(p);
    for (std::size_t i = 0; i < around.size(); ++i) {
      if (around[i] == q) return around[i + 1 < around.size() ? i + 1 : 0];
    }
    return kGap;
  }
  std::uint32_t before(std::uint32_t p, std::uint32_t q) const {
    const auto around = rim(p);
    for (std::size_t i = 0; i < around.size(); ++i) {
      if (around[i] == q) return around[i > 0 ? i - 1 : around.size() - 1];
    }
    return kGap;
  }

  /// Whether the fan of `p` has the triangle (p, q, r).
  bool has(std::uint32_t p, std::uint32_t q, std::uint32_t r) const { return after(p, q) == r; }

 private:
  friend bool build_fans(std::span<const Vec3f>, std::span<const Vec3f>, const NeighbourGrid&,
                         const NeighbourLists&, const FanRule&, const Context&, Fans&);
  void limit_spacing();

  std::vector<std::uint32_t> offsets_, rims_;
  std::vector<float> spacing_;
};

/// The local Delaunay stars of the points in their tangent planes, after the fans of Linsen and
/// Prautzsch 2001. A point's nearest neighbours whose normals agree with its own are projected
/// along its normal; its fan is its star in their Delaunay triangulation. As long as a
/// circumscribed circle of the fan, or a gap of 180 degrees or more, reaches beyond the neighbours
/// looked at, twice as many are taken, up to the limits of `rule`; those of `neighbours` come
/// first.
///
/// `grid` and `neighbours` are of `positions`, which are distinct; `normals` have unit length or
/// are 0 (a point without a normal has no fan and is in none). Cocircular points are triangulated
/// from the one with the smallest index, whichever fan asks. Returns false where cancelled. O(#P).
bool build_fans(std::span<const Vec3f> positions, std::span<const Vec3f> normals,
                const NeighbourGrid& grid, const NeighbourLists& neighbours, const FanRule& rule,
                const Context& context, Fans& fans);

}  // namespace burnish
