#include "two_sided_distance.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "burnish/base/parallel.h"
#include "burnish/measure/surface_samples.h"

namespace burnish {
namespace {

struct Sums {
  double squares = 0, max = 0;
};

/// Of `count` points, the i-th being `point(i)`.
template <class PointAt>
Sums distances(std::size_t count, PointAt point, const ClosestPoint& closest) {
  Sums total;
  const bool done = parallel_reduce(
      {}, count, total,
      [&](IndexRange range) {
        Sums sums;
        for (std::size_t i = range.begin; i < range.end; ++i) {
          const double distance = closest(point(i)).distance;
          sums.squares += distance * distance;
          sums.max = std::max(sums.max, distance);
        }
        return sums;
      },
      [](Sums& all, const Sums& part) {
        all.squares += part.squares;
        all.max = std::max(all.max, part.max);
      });
  if (!done) std::exit(1);
  return total;
}

Sums one_way(const TriangleMesh& from, const ClosestPoint& to, std::size_t samples) {
  const std::vector<SurfaceSample> spread = surface_samples(from, samples);
  Sums sums = distances(
      spread.size(), [&](std::size_t i) { return spread[i].point; }, to);
  sums.squares /= static_cast<double>(spread.size());
  const auto place = [&](std::uint32_t v) { return Vec3d(from.positions[v]); };
  const Sums vertices = distances(
      from.positions.size(), [&](std::size_t v) { return place(static_cast<std::uint32_t>(v)); },
      to);
  const Sums middles = distances(
      3 * from.triangles.size(),
      [&](std::size_t i) {
        const Triangle& t = from.triangles[i / 3];
        return 0.5 * (place(t[i % 3]) + place(t[(i + 1) % 3]));
      },
      to);
  sums.max = std::max({sums.max, vertices.max, middles.max});
  return sums;
}

}  // namespace

MeasuredSurface::MeasuredSurface(TriangleMesh surface)
    : mesh(without_unused_vertices(surface)), closest(mesh) {}

double TwoSidedDistance::rms() const {
  return std::sqrt(0.5 * (rms_there * rms_there + rms_back * rms_back));
}

double TwoSidedDistance::hausdorff() const {
  return std::max(max_there, max_back);
}

TwoSidedDistance two_sided_distance(const MeasuredSurface& a, const MeasuredSurface& b,
                                    std::size_t samples) {
  const Sums there = one_way(a.mesh, b.closest, samples),
             back = one_way(b.mesh, a.closest, samples);
  return {std::sqrt(there.squares), std::sqrt(back.squares), there.max, back.max};
}

}  // namespace burnish
