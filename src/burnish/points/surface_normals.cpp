#include "burnish/points/surface_normals.h"

#include <algorithm>

#include "burnish/base/parallel.h"
#include "burnish/points/orientation.h"
#include "burnish/points/variation.h"

namespace burnish {
namespace {

/// Of narrow strips more points are taken, twice as many at a time.
constexpr std::size_t kMostNeighbours = 96;

/// The normals of the points [range.begin, range.end), with either sign.
void fit_normals(IndexRange range, std::span<const Vec3f> positions, const NeighbourGrid& grid,
                 const NeighbourLists& neighbours, std::vector<Vec3f>& normals) {
  std::vector<Neighbour> found;
  std::vector<std::uint32_t> more;
  for (std::size_t i = range.begin; i < range.end; ++i) {
    Variation fit = variation(positions, neighbours.of(i));
    std::size_t count = neighbours.count();
    while (fit.breadth < kNarrow && count < std::min(kMostNeighbours, positions.size())) {
      count = std::min({2 * count, kMostNeighbours, positions.size()});
      grid.nearest(positions[i], count, found);
      more.clear();
      for (const Neighbour& neighbour : found) more.push_back(neighbour.index);
      fit = variation(positions, more);
    }
    normals[i] = Vec3f(fit.least);
  }
}

}  // namespace

bool normals_of_surface(std::span<const Vec3f> positions, const NeighbourGrid& grid,
                        const NeighbourLists& neighbours, const std::optional<Vec3d>& viewpoint,
                        const Context& context, std::vector<Vec3f>& normals,
                        std::size_t& components) {
  normals.assign(positions.size(), {});
  components = 0;
  const bool complete = parallel_for(context.part(0, 0.7), positions.size(), [&](IndexRange range) {
    fit_normals(range, positions, grid, neighbours, normals);
    for (std::size_t i = range.begin; viewpoint && i < range.end; ++i) {
      const Vec3d towards = *viewpoint - Vec3d(positions[i]);
      if (dot(Vec3d(normals[i]), towards) < 0) normals[i] = -normals[i];
    }
  });
  if (!complete) return false;
  if (!viewpoint) {
    components = orient_consistently(positions, grid, neighbours, normals, context.part(0.7, 1));
  }
  if (context.cancelled()) return false;
  context.progress(1);
  return true;
}

}  // namespace burnish
