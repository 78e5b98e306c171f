#pragma once

#include <cstdint>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/facts.h"
#include "burnish/base/result.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

struct CoverageParams {
  /// The mean distance of the points that the mesh was made from, m, >= 0. 0: as many points as the
  /// mesh uses spread over the area of the truth, sqrt(area / #points).
  double spacing = 0;
  double tolerance = 1;  ///< what is missing is farther than this from the mesh; spacings, > 0
  double far_away = 2;   ///< what is invented is farther than this from the truth; spacings, > 0
  int samples = 200000;  ///< on the truth; 1 to 100 million
};

/// How much of the true surface a mesh covers, and whether it holds surface that is not there.
struct SurfaceCoverage {
  double spacing = 0;        ///< as it was used, m
  double true_area = 0;      ///< m2
  double missing_area = 0;   ///< of the truth, m2
  double missing_share = 0;  ///< missing_area / true_area

  double farthest_triangle_distance = 0;  ///< of the triangle that is farthest from the truth, m
  std::uint32_t farthest_triangle = 0;    ///< the first of equals
  std::size_t far_triangles = 0;          ///< farther from the truth than `far_away` spacings

  double farthest_in_spacings() const { return farthest_triangle_distance / spacing; }
  Facts facts() const;
};

/// What compare_to_truth cannot tell: means over a surface hide holes and single wild triangles.
/// The share of the truth that is missing comes from samples spread evenly over it, those counted
/// that have no part of the mesh within the tolerance; its standard error is below
/// 1 / sqrt(samples). A hole narrower than twice the tolerance does not count. A triangle is as far
/// from the truth as the farthest of its corners, edge midpoints and centroid.
///
/// Both meshes in the same frame of coordinates (different Frame origins are taken into account).
/// Errors: invalid_argument; bad_geometry (also for a mesh without area); cancelled.
/// O((#V + #T + samples) log #T).
Result<SurfaceCoverage> surface_coverage(const TriangleMesh& mesh, const TriangleMesh& truth,
                                         const CoverageParams& params = {},
                                         const Context& context = {});

}  // namespace burnish
