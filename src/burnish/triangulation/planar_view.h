#pragma once

#include "burnish/base/tangent_frame.h"
#include "burnish/core/point_cloud.h"
#include "burnish/triangulation/delaunay.h"
#include "burnish/triangulation/predicates.h"

namespace burnish {

/// How a viewer sees the points of a cloud in a plane: along parallel lines, or by a pinhole
/// camera.
class PlanarView {
 public:
  /// As triangulate_delaunay() describes it. Depends on the finite points alone, not on their
  /// order. O(#P). Errors: bad_geometry.
  static Result<PlanarView> of(const PointCloud& cloud, Projection projection);

  /// In axes that are counter-clockwise for the viewer; exact along an axis.
  Vec2d operator()(const Vec3f& p) const;

  /// From `p` to the viewer; of whatever length.
  Vec3d to_viewer(const Vec3d& p) const { return central_ ? eye_ - p : frame_.normal; }

  /// Grows along the line of sight towards the viewer.
  double nearness(const Vec3f& p) const;

  /// Coordinates are multiples of this power of two; 0 where they are exact, along an axis.
  double step() const { return step_; }

 private:
  PlanarView(const Vec3d& towards, const Vec3d& eye, bool central)
      : frame_(towards), eye_(eye), central_(central) {}
  double depth(const Vec3d& from_eye) const { return -dot(from_eye, frame_.normal); }
  Result<void> measure(const PointCloud& cloud);

  TangentFrame frame_;  ///< whose normal points to the viewer; exact along an axis
  Vec3d eye_;           ///< in the cloud's frame; the origin for parallel lines
  bool central_;
  double step_ = 0;
};

}  // namespace burnish
