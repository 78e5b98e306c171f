#pragma once

#include "burnish/adaptation/refinement.h"
#include "burnish/base/schema.h"

namespace burnish {

struct MidpointParams {
  int iterations = 1;

  static const Schema<MidpointParams>& schema();
};

/// Every triangle becomes four by vertices in the middle of its edges. Nothing moves: the surface
/// is the same set of points, up to the rounding of the middles to floats. Where a channel
/// `refinement` confines it, triangles around are cut in two or three. Euler number, orientation
/// and manifoldness are kept. O(#T log valence) a pass. Errors: invalid_argument, bad_geometry,
/// cancelled; `mesh` is then unchanged.
Result<RefinementReport> refine_midpoint(TriangleMesh& mesh, const MidpointParams& params = {},
                                         const Context& context = {});

}  // namespace burnish
