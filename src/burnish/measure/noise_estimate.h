#pragma once

#include "burnish/base/facts.h"
#include "burnish/base/result.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

struct NoiseEstimate {
  double sigma = 0;           ///< standard deviation along the normals, m
  double relative_sigma = 0;  ///< in mean edge lengths
  std::size_t vertices = 0;   ///< that it was estimated from

  Facts facts() const;
};

/// How noisy a mesh is, from itself alone: for every interior vertex the offset from its ring's
/// mean along the ring-smoothed normal, h = n . (p - mean p_j); for independent noise on a smooth
/// surface h / sqrt(1 + 1/n) has its standard deviation, which the median of |h / sqrt(1 + 1/n)| /
/// 0.6745 estimates robustly. Curvature of the order of the edges adds to it; noise that is
/// correlated between neighbours, as depth cameras make it, is underestimated. Errors:
/// bad_geometry. O(#V + #T).
Result<NoiseEstimate> estimate_noise(const TriangleMesh& mesh);

}  // namespace burnish
