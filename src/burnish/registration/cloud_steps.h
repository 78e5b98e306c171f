#pragma once

#include <utility>

#include "burnish/registration/cloud_surface.h"
#include "burnish/registration/clouds.h"

namespace burnish {

/// Clouds ready to be registered, so that several starts share what they cost.
struct CloudTarget {
  CloudSurface surface;
  NeighbourGrid grid;

  explicit CloudTarget(CloudSurface s) : surface(std::move(s)), grid(surface.positions) {}
};

/// Both clouds of a pair. Errors say which they are of.
Result<std::pair<CloudTarget, CloudTarget>> cloud_surfaces(const PointCloud& source,
                                                           const PointCloud& target,
                                                           double distortion,
                                                           const Context& context);

/// The iterations of register_clouds and its verdict. T maps source positions to target positions,
/// both relative to their origins.
Result<PairRegistration> register_surfaces(const CloudTarget& source, const CloudTarget& target,
                                           const RigidTransform& T, const CloudsParams& params,
                                           const Context& context);

/// The pair with poses and twists between world coordinates instead of those relative to origins.
PairRegistration in_world(PairRegistration pair, const Vec3d& source_origin,
                          const Vec3d& target_origin);

}  // namespace burnish
