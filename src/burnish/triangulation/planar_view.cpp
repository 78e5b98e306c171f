#include "burnish/triangulation/planar_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "burnish/triangulation/point_moments.h"

namespace burnish {
namespace {

constexpr double kLeastCosine = 0.0175;  // 89 degrees

Vec3d axis_vector(std::size_t axis) {
  Vec3d result;
  result[axis] = 1;
  return result;
}

/// `direction`, or the opposite one, towards the viewpoint or where most normals look.
Vec3d towards_viewer(const Vec3d& direction, const Vec3d& mean, const PointCloud& cloud) {
  if (cloud.viewpoint) {
    const double side = dot(direction, *cloud.viewpoint - cloud.frame.origin - mean);
    if (side != 0) return side > 0 ? direction : -direction;
  }
  std::int64_t facing = 0;
  for (const Vec3f& normal : cloud.attributes.normals) {
    const double side = dot(direction, Vec3d(normal));
    facing += (side > 0) - (side < 0);
  }
  return facing >= 0 ? direction : -direction;
}

}  // namespace

Result<PlanarView> PlanarView::of(const PointCloud& cloud, Projection projection) {
  const PointMoments spread = moments(cloud.positions);
  if (projection == Projection::view) {
    if (!cloud.viewpoint) {
      return Error{
          ErrorCode::bad_geometry,
          "the cloud has no viewpoint to look from: the projection can be plane, x, y or z",
          {}};
    }
    const Vec3d eye = *cloud.viewpoint - cloud.frame.origin;
    PlanarView view(normalized(eye - spread.mean), eye, true);
    if (auto seen = view.measure(cloud); !seen) return seen.error();
    return view;
  }
  const Vec3d direction = projection == Projection::x   ? axis_vector(0)
                          : projection == Projection::y ? axis_vector(1)
                          : projection == Projection::z ? axis_vector(2)
                                                        : spread.least_direction;
  PlanarView view(towards_viewer(direction, spread.mean, cloud), {}, false);
  if (projection == Projection::plane) {
    if (auto seen = view.measure(cloud); !seen) return seen.error();
  }
  return view;
}

/// Coordinates are sums of products, divided by the depth, with errors of some 2^-52 of the longest
/// vector that is projected. In steps of 2^-32 points on one line of sight get the same ones, and
/// floats are still 250 times coarser.
Result<void> PlanarView::measure(const PointCloud& cloud) {
  double longest = 0;
  std::size_t hidden = 0, count = 0;
  for (const Vec3f& p : cloud.positions) {
    if (!is_finite(p)) continue;
    ++count;
    const Vec3d from_eye = Vec3d(p) - eye_;
    const double length = norm(from_eye);
    if (!central_) {
      longest = std::max(longest, length);
    } else if (depth(from_eye) > kLeastCosine * length) {
      longest = std::max(longest, length / depth(from_eye));
    } else {
      ++hidden;
    }
  }
  if (hidden > 0) {
    return Error{ErrorCode::bad_geometry,
                 fmt::format("{} of {} points are beside or behind the viewpoint, which looks at "
                             "their middle: the projection can be plane, x, y or z",
                             hidden, count),
                 {}};
  }
  if (longest > 0) step_ = std::ldexp(1, std::ilogb(longest) - 31);
  return {};
}

Vec2d PlanarView::operator()(const Vec3f& p) const {
  const Vec3d from_eye = Vec3d(p) - eye_;
  const double scale = central_ ? 1 / depth(from_eye) : 1;
  const double x = dot(from_eye, frame_.u) * scale, y = dot(from_eye, frame_.v) * scale;
  if (step_ == 0) return {x, y};
  return {std::nearbyint(x / step_) * step_, std::nearbyint(y / step_) * step_};
}

double PlanarView::nearness(const Vec3f& p) const {
  const Vec3d from_eye = Vec3d(p) - eye_;
  return central_ ? -squared_norm(from_eye) : dot(from_eye, frame_.normal);
}

}  // namespace burnish
