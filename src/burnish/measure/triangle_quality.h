#pragma once

#include "burnish/base/context.h"
#include "burnish/base/facts.h"
#include "burnish/base/result.h"
#include "burnish/core/triangle_mesh.h"
#include "burnish/measure/histogram.h"

namespace burnish {

/// How well shaped the triangles of a mesh are. Triangles without an area have angles as their
/// corners give them and radius ratio 0; angles at corners of coincident vertices are left out.
struct TriangleQuality {
  std::size_t triangles = 0;
  double smallest_angle = 0;       ///< of all, rad
  double smallest_angle_p01 = 0;   ///< 1 % of the triangles have a smaller least angle, rad
  double smallest_angle_mean = 0;  ///< mean of each triangle's least angle, rad; at best pi / 3
  double largest_angle = 0;        ///< of all, rad
  double radius_ratio_min = 0;     ///< 2 r / R of inscribed and circumscribed circle, 0 to 1
  double radius_ratio_mean = 0;
  double edge_length_mean = 0;  ///< over the distinct edges, m
  double edge_length_min = 0;
  double edge_length_max = 0;
  double edge_spread = 0;                ///< standard deviation / mean of the edge lengths
  double neighbour_distance_spread = 0;  ///< the mean over all vertices of standard deviation /
                                         ///< mean of their distances from their neighbours: in one
                                         ///< number, what Ozbay and Cinar tabulate as |d_avg - d_i|
  Histogram angles;        ///< of all corners, 0 to pi in 36 bins, rad
  Histogram edge_lengths;  ///< of the distinct edges, 0 to 3 means in 60 bins, m

  Facts facts() const;
};

/// Errors: bad_geometry, cancelled. O(#V + #T).
Result<TriangleQuality> triangle_quality(const TriangleMesh& mesh, const Context& context = {});

/// 2 r / R = 16 A^2 / (abc (a + b + c)) from the side lengths' triangle; 1 if equilateral, 0 if
/// flat.
double radius_ratio(const Vec3d& a, const Vec3d& b, const Vec3d& c);

}  // namespace burnish
