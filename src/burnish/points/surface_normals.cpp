#include "burnish/points/surface_normals.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "burnish/base/parallel.h"
#include "burnish/points/orientation.h"

namespace burnish {
namespace {

/// Points whose second variance is a smaller part of the first are on a line.
constexpr double kLine = 1e-6;
/// Those of a narrow strip (one part wide, three long) do not tell a plane from a curve: more are
/// taken, twice as many at a time.
constexpr double kNarrow = 0.1;
constexpr std::size_t kMostNeighbours = 96;

/// A symmetric matrix: its diagonal and what is beside it.
struct Symmetric {
  double xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;
};

/// The covariance of the points, times a factor that makes its trace 1; 0 where they coincide.
Symmetric covariance(std::span<const Vec3f> positions, std::span<const std::uint32_t> which) {
  const Vec3d first(positions[which.front()]);
  Vec3d sum;
  Symmetric m;
  for (const std::uint32_t i : which) {
    const Vec3d d = Vec3d(positions[i]) - first;
    sum += d;
    m.xx += d.x * d.x, m.yy += d.y * d.y, m.zz += d.z * d.z;
    m.xy += d.x * d.y, m.yz += d.y * d.z, m.zx += d.z * d.x;
  }
  const Vec3d mean = sum / static_cast<double>(which.size());
  m.xx -= sum.x * mean.x, m.yy -= sum.y * mean.y, m.zz -= sum.z * mean.z;
  m.xy -= sum.x * mean.y, m.yz -= sum.y * mean.z, m.zx -= sum.z * mean.x;
  const double trace = m.xx + m.yy + m.zz;
  if (!(trace > 0)) return {};
  const double scale = 1 / trace;
  return {m.xx * scale, m.yy * scale, m.zz * scale, m.xy * scale, m.yz * scale, m.zx * scale};
}

/// The smallest root of x^3 - x^2 + b x - c, which has three in [0, 1]: left of it the polynomial
/// is concave and rises, so that Newton's steps from 0 come to it without passing it.
double smallest_root(double b, double c) {
  double x = 0;
  for (int step = 0; step < 60; ++step) {
    const double value = ((x - 1) * x + b) * x - c;
    const double slope = (3 * x - 2) * x + b;
    if (!(value < 0) || !(slope > 0)) break;
    const double next = x - value / slope;
    if (next - x <= 1e-15) break;
    x = next;
  }
  return x;
}

/// How points vary around their mean.
struct Variation {
  Vec3d least;         ///< the direction of unit length in which they vary least; 0: no plane
  double breadth = 0;  ///< second largest variance over the largest
};

Variation variation(std::span<const Vec3f> positions, std::span<const std::uint32_t> which) {
  if (which.size() < 3) return {};
  Symmetric m = covariance(positions, which);
  const double minors =
      m.xx * m.yy - m.xy * m.xy + m.yy * m.zz - m.yz * m.yz + m.zz * m.xx - m.zx * m.zx;
  const double determinant = m.xx * (m.yy * m.zz - m.yz * m.yz) -
                             m.xy * (m.xy * m.zz - m.yz * m.zx) +
                             m.zx * (m.xy * m.yz - m.yy * m.zx);
  const double smallest = smallest_root(minors, determinant);
  // The others: their sum is 1 - smallest, and their product is known.
  const double sum = 1 - smallest, product = minors - smallest * sum;
  const double largest = (sum + std::sqrt(std::max(sum * sum - 4 * product, 0.0))) / 2;
  const double breadth = (sum - largest) / largest;
  if (!(breadth > kLine)) return {};
  m.xx -= smallest, m.yy -= smallest, m.zz -= smallest;
  const std::array<Vec3d, 3> rows{{{m.xx, m.xy, m.zx}, {m.xy, m.yy, m.yz}, {m.zx, m.yz, m.zz}}};
  // All three are along the direction; the longest is the exactest.
  const std::array<Vec3d, 3> along{cross(rows[0], rows[1]), cross(rows[1], rows[2]),
                                   cross(rows[2], rows[0])};
  const Vec3d& best = *std::max_element(
      along.begin(), along.end(),
      [](const Vec3d& a, const Vec3d& b) { return squared_norm(a) < squared_norm(b); });
  return {normalized(best), breadth};
}

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
