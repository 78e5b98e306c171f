#include "burnish/triangulation/local_fans.h"

#include <algorithm>
#include <cmath>

#include "burnish/base/parallel.h"
#include "burnish/triangulation/delaunay_star.h"

namespace burnish {
namespace {

constexpr std::size_t kPointsAtOnce = 1024;
constexpr std::size_t kSpacingNeighbour = 8;
/// By how much the spacing may grow from a point to a neighbour.
constexpr float kSpacingGrowth = 2;
/// A neighbour seen under a steeper angle to the tangent plane (60 degrees) is above or below the
/// point, not beside it.
constexpr double kSteepSquaredSine = 0.75;

/// Two unit vectors that make a right-handed frame with the unit vector n (Duff et al. 2017).
void tangents(const Vec3d& n, Vec3d& u, Vec3d& v) {
  const double sign = std::copysign(1.0, n.z);
  const double a = -1 / (sign + n.z), b = n.x * n.y * a;
  u = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
  v = {b, sign + n.y * n.y * a, -n.y};
}

/// Builds fan after fan with the same scratch memory.
class FanBuilder {
 public:
  FanBuilder(std::span<const Vec3f> positions, std::span<const Vec3f> normals,
             const NeighbourGrid& grid, const FanRule& rule)
      : positions_(positions), normals_(normals), grid_(grid), rule_(rule) {}

  /// Appends the rim of `p`; gives its spacing.
  double append(std::uint32_t p, std::vector<std::uint32_t>& rims) {
    const std::size_t limit = std::min(rule_.most_neighbours + 1, positions_.size());
    double spacing = 0;
    for (std::size_t count = std::min(rule_.first_neighbours + 1, limit);;) {
      grid_.nearest(positions_[p], count, neighbours_);
      spacing = std::sqrt(neighbours_[std::min(kSpacingNeighbour, count - 1)].squared_distance);
      project(p);
      star_.build(plane_, p);
      const double known = neighbours_.back().squared_distance;
      const double needed = std::pow(rule_.reach * spacing, 2);
      const bool complete = star_.closed() && star_.squared_diameter() <= known;
      if (complete || known >= needed || count == limit) break;
      count = std::min(2 * count, limit);
    }
    for (const std::uint32_t i : star_.rim()) rims.push_back(plane_[i].index);
    if (!star_.closed() && !star_.rim().empty()) rims.push_back(Fans::kGap);
    return spacing;
  }

 private:
  /// The neighbours on the sheet of `p`, in its tangent plane.
  void project(std::uint32_t p) {
    plane_.clear();
    const Vec3d centre(positions_[p]), normal(normals_[p]);
    if (squared_norm(normal) == 0) return;
    Vec3d u, v;
    tangents(normal, u, v);
    for (const Neighbour& neighbour : neighbours_) {
      const Vec3d other(normals_[neighbour.index]);
      if (neighbour.index == p || dot(normal, other) <= rule_.cos_sheet_angle) continue;
      const Vec3d to = Vec3d(positions_[neighbour.index]) - centre;
      const double height = dot(normal, to);
      if (height * height > kSteepSquaredSine * neighbour.squared_distance) continue;
      plane_.push_back({dot(u, to), dot(v, to), neighbour.index});
    }
  }

  std::span<const Vec3f> positions_, normals_;
  const NeighbourGrid& grid_;
  const FanRule& rule_;
  std::vector<Neighbour> neighbours_;
  std::vector<PlanePoint> plane_;
  DelaunayStar star_;
};

}  // namespace

/// A point far from all others would reach for them over any distance: its own spacing says nothing
/// of a surface there where no neighbour's is alike.
void limit_spacing(Fans& fans) {
  const std::vector<float> own = fans.spacing_;
  for (std::size_t p = 0; p < own.size(); ++p) {
    float widest = 0;
    for (const std::uint32_t q : fans.rim(p)) {
      if (q != Fans::kGap) widest = std::max(widest, own[q]);
    }
    fans.spacing_[p] = std::min(own[p], kSpacingGrowth * widest);
  }
}

bool build_fans(std::span<const Vec3f> positions, std::span<const Vec3f> normals,
                const NeighbourGrid& grid, const FanRule& rule, const Context& context,
                Fans& fans) {
  const std::size_t count = positions.size();
  const std::size_t blocks = (count + kPointsAtOnce - 1) / kPointsAtOnce;
  std::vector<std::vector<std::uint32_t>> rims(blocks);
  fans.offsets_.assign(count + 1, 0);
  fans.spacing_.assign(count, 0);
  const bool complete = parallel_for(
      context, blocks,
      [&](IndexRange range) {
        FanBuilder builder(positions, normals, grid, rule);
        for (std::size_t block = range.begin; block < range.end; ++block) {
          rims[block].reserve(7 * kPointsAtOnce);
          const std::size_t end = std::min(count, (block + 1) * kPointsAtOnce);
          for (std::size_t p = block * kPointsAtOnce; p < end; ++p) {
            const std::size_t before = rims[block].size();
            const double spacing = builder.append(static_cast<std::uint32_t>(p), rims[block]);
            fans.spacing_[p] = static_cast<float>(spacing);
            fans.offsets_[p + 1] = static_cast<std::uint32_t>(rims[block].size() - before);
          }
        }
      },
      1);
  if (!complete) return false;
  for (std::size_t p = 0; p < count; ++p) fans.offsets_[p + 1] += fans.offsets_[p];
  fans.rims_.clear();
  fans.rims_.reserve(fans.offsets_[count]);
  for (const auto& block : rims) fans.rims_.insert(fans.rims_.end(), block.begin(), block.end());
  limit_spacing(fans);
  return true;
}

}  // namespace burnish
