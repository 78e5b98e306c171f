#include "burnish/points/surface_normals.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "burnish/base/parallel.h"
#include "burnish/base/tangent_frame.h"
#include "burnish/points/orientation.h"
#include "burnish/points/variation.h"

namespace burnish {
namespace {

/// Where the nearest points lie along a line, so many are looked at for others beside it.
constexpr std::size_t kMostNeighbours = 96;
/// So many of the nearest say which way the line goes, and so many beside it where its plane lies.
constexpr std::size_t kAlong = 8, kBeside = 6;
/// Breadth of the nearest along a line, though it be curved.
constexpr double kStraight = 0.02;

/// The mean direction of the nearest points, seen as an axis.
Vec3d axis_of(std::span<const Vec3f> positions, std::uint32_t p,
              std::span<const std::uint32_t> nearest) {
  Vec3d sum;
  for (const std::uint32_t q : nearest) {
    const Vec3d d = Vec3d(positions[q]) - Vec3d(positions[p]);
    sum += dot(d, sum) < 0 ? -d : d;
  }
  return normalized(sum);
}

/// The normal at `p` of a surface that is sampled much denser along lines than across them: that of
/// the plane of the line's axis and of the nearest points that lie beside it, each of which counts
/// by its direction alone. 0 where there are none.
Vec3d normal_across_lines(std::span<const Vec3f> positions, std::uint32_t p,
                          const std::vector<Neighbour>& near) {
  std::array<std::uint32_t, kAlong> nearest;
  const std::size_t along = std::min(kAlong, near.size());
  for (std::size_t i = 0; i < along; ++i) nearest[i] = near[i].index;
  const Vec3d axis = axis_of(positions, p, std::span(nearest).first(along));
  if (squared_norm(axis) == 0) return {};
  const TangentFrame across(axis);
  // The mean of directions as axes: that of their doubled angles.
  double cosine = 0, sine = 0;
  std::size_t beside = 0;
  for (const Neighbour& neighbour : near) {
    const Vec3d d = Vec3d(positions[neighbour.index]) - Vec3d(positions[p]);
    const double x = dot(d, across.u), y = dot(d, across.v), squared = x * x + y * y;
    if (2 * squared <= neighbour.squared_distance) continue;
    cosine += (x * x - y * y) / squared;
    sine += 2 * x * y / squared;
    if (++beside == kBeside) break;
  }
  const double length = std::sqrt(cosine * cosine + sine * sine);
  if (!(length > 0)) return {};
  const double u = std::sqrt(std::max(0.0, (1 + cosine / length) / 2));
  const double v = std::copysign(std::sqrt(std::max(0.0, (1 - cosine / length) / 2)), sine);
  return normalized(cross(axis, across.u * u + across.v * v));
}

/// The normals of the points [range.begin, range.end), with either sign.
void fit_normals(IndexRange range, std::span<const Vec3f> positions, const NeighbourGrid& grid,
                 const NeighbourLists& neighbours, std::vector<Vec3f>& normals) {
  std::vector<Neighbour> found;
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const Variation fit = variation(positions, neighbours.of(i));
    Vec3d normal = fit.least;
    if (neighbours.count() >= kAlong &&
        (fit.breadth < kNarrow ||
         variation(positions, neighbours.of(i).first(kAlong)).breadth < kStraight)) {
      grid.nearest(positions[i], kMostNeighbours, found);
      normal = normal_across_lines(positions, static_cast<std::uint32_t>(i), found);
    }
    normals[i] = Vec3f(normal);
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
