#pragma once

#include "burnish/registration/clouds.h"
#include "burnish/registration/projective.h"

namespace burnish {

struct GlobalStartParams {
  double cell = 0;     ///< m, side of the cells to which clouds are thinned; 0: a sixteenth of the
                       ///< target's radius
  int draws = 200000;  ///< triples of correspondences that are tried
  int starts = 8;      ///< poses that are refined

  static const Schema<GlobalStartParams>& schema();
};

/// How two clouds lie to each other when nothing is known of it. Thinned to cells, the points are
/// described by FPFH (fpfh.h) over five cells; where descriptors match mutually, sample consensus
/// finds poses (consensus.h); the best of them by the share of the source's cells that they bring
/// onto the target are refined by register_clouds, whose verdict holds: the accepted pose of
/// largest overlap, or where none is the one that most of the source agrees with. Histograms of
/// angles rather than learned features, because they need no training and give the same bytes
/// everywhere. context.seed chooses the triples. O(#P log #P + cells^2). Errors: as
/// register_clouds.
Result<PairRegistration> register_clouds_globally(const PointCloud& source,
                                                  const PointCloud& target,
                                                  const GlobalStartParams& start = {},
                                                  const CloudsParams& params = {},
                                                  const Context& context = {});

/// The same for frames, refined and judged by register_projective.
Result<PairRegistration> register_views_globally(const SurfaceView& source,
                                                 const SurfaceView& target,
                                                 const GlobalStartParams& start = {},
                                                 const ProjectiveParams& params = {},
                                                 const Context& context = {});

}  // namespace burnish
