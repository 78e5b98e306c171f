#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/rigid.h"
#include "burnish/core/point_cloud.h"

namespace burnish {

/// A cloud seen from one point, in projective coordinates: u = x/z, v = y/z, w = 1/z about an axis
/// through the middle of the view. Planes stay planes (w = a u + b v + c), the grid stays a grid,
/// and the noise of depth cameras lies in w alone.
struct ProjectiveGrid {
  struct Pixel {
    double u = 0, v = 0;
    double w = 0;  ///< 1/m; 0: missing or not in front of the viewpoint
  };
  GridSize size;
  RigidTransform T_cloud_view;  ///< z along the view's axis, from the viewpoint
  std::vector<Pixel> pixels;
};

/// Where an organized cloud was seen from: its viewpoint or, where it names none, the origin of its
/// coordinates, in which depth cameras write.
Vec3d viewpoint_or_origin(const PointCloud& cloud);

/// The cloud, which must be organized, in projective coordinates. O(#P).
ProjectiveGrid project_grid(const PointCloud& cloud);

/// The median angle between the rays of neighbouring pixels, rad; 0 where no two have a depth.
double pixel_pitch(const ProjectiveGrid& grid);

/// Standard deviation of the depth along the ray, m, for every pixel: `sigma` where it is given,
/// otherwise one figure in w for the whole grid, from its second differences along the rows.
std::vector<float> depth_noise(const ProjectiveGrid& grid, std::span<const float> sigma);

/// Whether two neighbouring pixels of the grid can belong to one surface: their depths differ by no
/// more than three standard deviations and what a surface tilted by 75 degrees explains.
inline bool same_surface(const ProjectiveGrid::Pixel& a, const ProjectiveGrid::Pixel& b,
                         double noise) {
  constexpr double kSteepest = 3.73;  // tan 75 degrees
  if (!(a.w > 0 && b.w > 0)) return false;
  // |1/a.w - 1/b.w| <= 3 noise + steepest * distance across the view, times a.w b.w.
  const double du = a.u - b.u, dv = a.v - b.v;
  const double across = std::sqrt(du * du + dv * dv) * std::min(a.w, b.w);
  return std::abs(a.w - b.w) <= 3 * noise * (a.w * b.w) + kSteepest * across;
}

/// Normals of unit length towards the viewpoint, 0 where fewer than three pixels or only a line of
/// them support one. Least squares of w over (u, v) in a window that grows from its pixel along the
/// column and from there along the rows, and ends at depth jumps (the cross of Zhang, Lu and
/// Lafruit 2009): rows by prefix sums, so that the cost hardly depends on the window. `radius` 0:
/// the smallest that brings the standard deviation of the slope to 3 degrees for white noise, 1
/// to 8. Returns false where cancelled. O(#P * radius).
[[nodiscard]] bool organized_normals(const ProjectiveGrid& grid, std::span<const float> noise,
                                     int radius, const Context& context,
                                     std::vector<Vec3f>& normals);

}  // namespace burnish
