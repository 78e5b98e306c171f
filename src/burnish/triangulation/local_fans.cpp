#include "burnish/triangulation/local_fans.h"

#include <algorithm>
#include <cmath>

#include "burnish/base/parallel.h"
#include "burnish/base/tangent_frame.h"
#include "burnish/triangulation/delaunay_star.h"

namespace burnish {
namespace {

constexpr std::size_t kPointsAtOnce = 1024;
/// A fan needs to know no more around it than so many times the distance of the eighth neighbour.
constexpr double kReach = 2.5;
/// By how much the spacing may grow from a point to a neighbour.
constexpr float kSpacingGrowth = 2;
/// A neighbour seen under a steeper angle to the tangent plane (60 degrees) is above or below the
/// point, not beside it.
constexpr double kSteepSquaredSine = 0.75;
/// Where the normals are alike (37 degrees) it is noise that lifts it: two sheets that face the
/// same way have a third between them.
constexpr double kAlike = 0.8, kAlikeSquaredSine = 0.99;

/// Builds fan after fan with the same scratch memory.
class StarBuilder {
 public:
  StarBuilder(std::span<const Vec3f> positions, std::span<const Vec3f> normals,
              const NeighbourGrid& grid, const NeighbourLists& neighbours, const FanRule& rule)
      : positions_(positions),
        normals_(normals),
        grid_(grid),
        neighbours_(neighbours),
        rule_(rule) {}

  /// Appends the rim of `p`; gives its spacing.
  double append(std::uint32_t p, std::vector<std::uint32_t>& rims) {
    std::span<const std::uint32_t> near = neighbours_.of(p);
    const std::size_t limit = std::min(rule_.most_neighbours + 1, positions_.size());
    const double enough = kReach * distance(p, near[std::min<std::size_t>(8, near.size() - 1)]);
    for (;;) {
      project(p, near);
      star_.build(plane_, p);
      const double known = distance(p, near.back());
      const bool complete = star_.closed() && star_.squared_diameter() <= known * known;
      if (complete || known >= enough || near.size() >= limit) break;
      near = look_further(p, std::min(2 * near.size(), limit));
    }
    for (const std::uint32_t i : star_.rim()) rims.push_back(plane_[i].index);
    if (!star_.closed() && !star_.rim().empty()) rims.push_back(Fans::kGap);
    return median_edge(p);
  }

 private:
  double distance(std::uint32_t p, std::uint32_t q) const {
    return norm(Vec3d(positions_[q]) - Vec3d(positions_[p]));
  }

  /// Half the edges to the rim are at least as long.
  double median_edge(std::uint32_t p) {
    edges_.clear();
    for (const std::uint32_t i : star_.rim()) {
      edges_.push_back(squared_norm(Vec3d(positions_[plane_[i].index]) - Vec3d(positions_[p])));
    }
    if (edges_.empty()) return 0;
    const auto middle = edges_.begin() + static_cast<std::ptrdiff_t>(edges_.size() / 2);
    std::nth_element(edges_.begin(), middle, edges_.end());
    return std::sqrt(*middle);
  }

  std::span<const std::uint32_t> look_further(std::uint32_t p, std::size_t count) {
    grid_.nearest(positions_[p], count, found_);
    further_.resize(found_.size());
    std::transform(found_.begin(), found_.end(), further_.begin(),
                   [](const Neighbour& neighbour) { return neighbour.index; });
    return further_;
  }

  /// The neighbours on the sheet of `p`, in its tangent plane.
  void project(std::uint32_t p, std::span<const std::uint32_t> near) {
    plane_.clear();
    const Vec3d centre(positions_[p]), normal(normals_[p]);
    if (squared_norm(normal) == 0) return;
    const TangentFrame tangents(normal);
    for (const std::uint32_t q : near) {
      const double alike = dot(normal, Vec3d(normals_[q]));
      if (q == p || alike <= rule_.cos_sheet_angle) continue;
      const Vec3d to = Vec3d(positions_[q]) - centre;
      const double height = dot(normal, to);
      const double steepest = alike > kAlike ? kAlikeSquaredSine : kSteepSquaredSine;
      if (height * height > steepest * squared_norm(to)) continue;
      plane_.push_back({dot(tangents.u, to), dot(tangents.v, to), q});
    }
  }

  std::span<const Vec3f> positions_, normals_;
  const NeighbourGrid& grid_;
  const NeighbourLists& neighbours_;
  const FanRule& rule_;
  std::vector<Neighbour> found_;
  std::vector<std::uint32_t> further_;
  std::vector<PlanePoint> plane_;
  std::vector<double> edges_;
  DelaunayStar star_;
};

}  // namespace

/// A point far from all others would reach for them over any distance: its own spacing says nothing
/// of a surface there where no neighbour's is alike.
void Fans::limit_spacing() {
  const std::vector<float> own = spacing_;
  for (std::size_t p = 0; p < own.size(); ++p) {
    float widest = 0;
    for (const std::uint32_t q : rim(p)) {
      if (q != kGap) widest = std::max(widest, own[q]);
    }
    spacing_[p] = std::min(own[p], kSpacingGrowth * widest);
  }
}

bool build_fans(std::span<const Vec3f> positions, std::span<const Vec3f> normals,
                const NeighbourGrid& grid, const NeighbourLists& neighbours, const FanRule& rule,
                const Context& context, Fans& fans) {
  const std::size_t count = positions.size();
  const std::size_t blocks = (count + kPointsAtOnce - 1) / kPointsAtOnce;
  std::vector<std::vector<std::uint32_t>> rims(blocks);
  fans.offsets_.assign(count + 1, 0);
  fans.spacing_.assign(count, 0);
  const bool complete = parallel_for(
      context, blocks,
      [&](IndexRange range) {
        StarBuilder builder(positions, normals, grid, neighbours, rule);
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
  fans.limit_spacing();
  return true;
}

}  // namespace burnish
