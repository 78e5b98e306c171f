#pragma once

#include "burnish/core/triangle_mesh.h"
#include "burnish/spatial/closest_point.h"

namespace burnish {

/// A surface with what is needed to ask again and again how far others are from it.
struct MeasuredSurface {
  explicit MeasuredSurface(TriangleMesh surface);

  TriangleMesh mesh;  ///< without the vertices that no triangle uses
  ClosestPoint closest;
};

/// Distances between two surfaces, m.
struct TwoSidedDistance {
  double rms_there = 0, rms_back = 0;  ///< from the first to the second and back, of the samples
  double max_there = 0, max_back = 0;  ///< of samples, vertices and middles of edges

  double rms() const;  ///< the root of the mean of both ways' squares
  double hausdorff() const;
};

/// By `samples` points spread evenly over each surface and, for the greatest, by all vertices and
/// all middles of edges too.
TwoSidedDistance two_sided_distance(const MeasuredSurface& a, const MeasuredSurface& b,
                                    std::size_t samples);

}  // namespace burnish
