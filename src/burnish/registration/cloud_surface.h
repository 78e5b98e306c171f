#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/result.h"
#include "burnish/core/point_cloud.h"
#include "burnish/spatial/neighbour_grid.h"

namespace burnish {

/// The points of a cloud that have a normal, as registration looks at them.
struct CloudSurface {
  std::vector<Vec3f> positions;  ///< relative to `origin`
  std::vector<Vec3f> normals;    ///< unit length
  std::vector<float> sigma;      ///< one standard deviation across the surface, random error, m
  std::vector<float> bias;       ///< the same of the systematic error
  std::vector<float> spacing;    ///< to neighbours on the surface, m
  Vec3d origin;                  ///< world coordinates
  bool oriented = true;          ///< whether normals are known to point to where it was seen from
  double noise_points = 1;       ///< neighbours that share their random error
  double radius = 0;             ///< root mean square distance from the mean of the points, m
  Vec3d middle;                  ///< that mean, relative to origin

  std::size_t size() const { return positions.size(); }
};

/// Normals are the cloud's, or estimated; sigma is the cloud's, or what the neighbours of a point
/// scatter about their plane by. Bias: `distortion` z^2 cos(theta) where it is known from where the
/// cloud was seen (surface_view.h says why), and `roughness` of the spacing, by which surfaces
/// leave their planes between the points. O(#P log #P). Errors: bad_geometry, cancelled.
Result<CloudSurface> cloud_surface(const PointCloud& cloud, double distortion,
                                   const Context& context);

/// About `count` of `total` numbers in rising order, drawn evenly; all where there are no more. The
/// same numbers for the same arguments.
std::vector<std::uint32_t> sample(std::size_t total, std::size_t count, std::uint64_t seed);

}  // namespace burnish
