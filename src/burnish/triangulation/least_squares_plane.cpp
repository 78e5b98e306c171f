#include "burnish/triangulation/least_squares_plane.h"

#include <algorithm>

namespace burnish {
namespace {

/// Points whose variance across is a smaller share of that along are on a line.
constexpr double kLine = 1e-6;

/// A symmetric matrix.
struct Covariance {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

  void add(const Vec3d& d) {
    xx += d.x * d.x, xy += d.x * d.y, xz += d.x * d.z;
    yy += d.y * d.y, yz += d.y * d.z, zz += d.z * d.z;
  }
};

/// The direction of least variance, 0 where there is none. The variances are the roots of a cubic;
/// Newton's method comes from 0 to the least of them and never passes it.
Vec3d least_direction(const Covariance& m) {
  const double sum = m.xx + m.yy + m.zz;
  const double minor_x = m.yy * m.zz - m.yz * m.yz, minor_y = m.xx * m.zz - m.xz * m.xz,
               minor_z = m.xx * m.yy - m.xy * m.xy;
  const double pairs = minor_x + minor_y + minor_z;
  const double product =
      m.xx * minor_x - m.xy * (m.xy * m.zz - m.xz * m.yz) + m.xz * (m.xy * m.yz - m.xz * m.yy);
  double least = 0;
  for (int i = 0; i < 50; ++i) {
    const double value = ((least - sum) * least + pairs) * least - product;
    const double slope = (3 * least - 2 * sum) * least + pairs;
    if (!(value < 0) || !(slope > 0)) break;
    const double next = least - value / slope;
    if (!(next > least)) break;
    least = next;
  }
  const double others = sum - least;  // middle + largest
  if (!(pairs - least * others > kLine * others * others)) return {};
  // The rows of what is left are perpendicular to it.
  const Vec3d a{m.xx - least, m.xy, m.xz}, b{m.xy, m.yy - least, m.yz}, c{m.xz, m.yz, m.zz - least};
  const Vec3d ab = cross(a, b), bc = cross(b, c), ca = cross(c, a);
  const double n_ab = squared_norm(ab), n_bc = squared_norm(bc), n_ca = squared_norm(ca);
  if (n_ab >= n_bc && n_ab >= n_ca) return normalized(ab);
  return normalized(n_bc >= n_ca ? bc : ca);
}

}  // namespace

Vec3d least_squares_normal(std::span<const Vec3f> positions, std::uint32_t point,
                           std::span<const Neighbour> neighbours) {
  if (neighbours.size() < 2) return {};
  const Vec3d origin(positions[point]);
  Vec3d mean;
  for (const Neighbour& q : neighbours) mean += Vec3d(positions[q.index]) - origin;
  mean = mean / (static_cast<double>(neighbours.size()) + 1);
  Covariance covariance;
  covariance.add(mean);
  for (const Neighbour& q : neighbours) {
    covariance.add(Vec3d(positions[q.index]) - origin - mean);
  }
  const Vec3d normal = least_direction(covariance);
  const double largest = std::max({normal.x, normal.y, normal.z});
  const double smallest = std::min({normal.x, normal.y, normal.z});
  return largest < -smallest ? -normal : normal;
}

}  // namespace burnish
