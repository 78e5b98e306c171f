#include "burnish/registration/fpfh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "burnish/base/parallel.h"
#include "burnish/spatial/neighbour_grid.h"

namespace burnish {
namespace {

constexpr std::size_t kBins = 11;
constexpr std::size_t kGrain = 64;

std::size_t bin_of(double value, double low, double high) {
  const double place = (value - low) / (high - low) * static_cast<double>(kBins);
  return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(kBins) - 0.5));
}

/// Adds the angles of a pair to a histogram. Of the two the one is the origin whose normal is
/// nearer to the line between them, so that both see the same pair.
void add_pair(const Vec3d& p, const Vec3d& n, const Vec3d& q, const Vec3d& m, Fpfh& histogram) {
  const double distance = norm(q - p);
  if (!(distance > 0)) return;
  Vec3d line = (q - p) / distance;
  Vec3d u = n, other = m;
  if (std::abs(dot(n, line)) < std::abs(dot(m, line))) {
    u = m, other = n, line = -line;
  }
  const Vec3d v = normalized(cross(line, u));
  if (v == Vec3d{}) return;
  const Vec3d w = cross(u, v);
  histogram[bin_of(dot(v, other), -1, 1)] += 1;
  histogram[kBins + bin_of(dot(u, line), -1, 1)] += 1;
  histogram[2 * kBins + bin_of(std::atan2(dot(w, other), dot(u, other)), -std::numbers::pi,
                               std::numbers::pi)] += 1;
}

void normalise(Fpfh& histogram) {
  for (std::size_t part = 0; part < 3; ++part) {
    float sum = 0;
    for (std::size_t i = 0; i < kBins; ++i) sum += histogram[part * kBins + i];
    if (!(sum > 0)) continue;
    for (std::size_t i = 0; i < kBins; ++i) histogram[part * kBins + i] /= sum;
  }
}

/// Where a point lies among the cells.
struct Cell {
  std::array<std::int64_t, 3> place;
  std::uint32_t point;

  friend auto operator<=>(const Cell&, const Cell&) = default;
};

}  // namespace

OrientedPoints thinned(std::span<const Vec3f> positions, std::span<const Vec3f> normals,
                       double cell) {
  std::vector<Cell> cells(positions.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Vec3d p(positions[i]);
    cells[i] = {{static_cast<std::int64_t>(std::floor(p.x / cell)),
                 static_cast<std::int64_t>(std::floor(p.y / cell)),
                 static_cast<std::int64_t>(std::floor(p.z / cell))},
                static_cast<std::uint32_t>(i)};
  }
  std::sort(cells.begin(), cells.end());
  OrientedPoints result;
  for (std::size_t i = 0; i < cells.size();) {
    Vec3d position, normal;
    std::size_t end = i;
    for (; end < cells.size() && cells[end].place == cells[i].place; ++end) {
      position += Vec3d(positions[cells[end].point]);
      normal += Vec3d(normals[cells[end].point]);
    }
    const double count = static_cast<double>(end - i);
    if (norm(normal) > 0.3 * count) {
      result.positions.push_back(Vec3f(position / count));
      result.normals.push_back(Vec3f(normalized(normal)));
    }
    i = end;
  }
  return result;
}

std::vector<Fpfh> fpfh(const OrientedPoints& points, double radius, const Context& context) {
  const NeighbourGrid grid(points.positions);
  std::vector<Fpfh> simple(points.size()), result(points.size());
  const auto for_points = [&](const Context& part, const auto& body) {
    return parallel_for(
        part, points.size(),
        [&](IndexRange range) {
          std::vector<Neighbour> near;
          for (std::size_t i = range.begin; i < range.end; ++i) {
            grid.within(points.positions[i], radius, near);
            body(i, near);
          }
        },
        kGrain);
  };
  const bool complete =
      for_points(context.part(0, 0.5),
                 [&](std::size_t i, const std::vector<Neighbour>& near) {
                   for (const Neighbour& j : near) {
                     if (j.index == i) continue;
                     add_pair(Vec3d(points.positions[i]), Vec3d(points.normals[i]),
                              Vec3d(points.positions[j.index]), Vec3d(points.normals[j.index]),
                              simple[i]);
                   }
                   normalise(simple[i]);
                 }) &&
      for_points(context.part(0.5, 1), [&](std::size_t i, const std::vector<Neighbour>& near) {
        Fpfh around{};
        double weights = 0;
        for (const Neighbour& j : near) {
          if (j.index == i || !(j.squared_distance > 0)) continue;
          const double weight = radius / std::sqrt(j.squared_distance);
          weights += 1;
          for (std::size_t b = 0; b < around.size(); ++b) {
            around[b] += static_cast<float>(weight) * simple[j.index][b];
          }
        }
        result[i] = simple[i];
        if (!(weights > 0)) return;
        for (std::size_t b = 0; b < around.size(); ++b) {
          result[i][b] += around[b] / static_cast<float>(weights);
        }
        normalise(result[i]);
      });
  if (!complete) return {};
  return result;
}

}  // namespace burnish
