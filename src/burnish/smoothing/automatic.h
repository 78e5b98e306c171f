#pragma once

#include "burnish/base/schema.h"
#include "burnish/smoothing/smoothing.h"

namespace burnish {

struct AutoParams {
  BoundaryRule boundary = BoundaryRule::free;  ///< normals pull nothing inwards

  static const Schema<AutoParams>& schema();
};

/// Removes the noise that is there, and as much as is there, with nothing to set. Of every face
/// several normals are computed as classical filters would give them (plain means and bilateral
/// ones, after few and after many passes); a small network, which has seen noisy and true shapes,
/// says how much of each is in the true one, in a frame that turns with the surface; the vertices
/// follow (vertex_update.h). All of it three times. The idea of choosing among filtered normals by
/// regression is that of Wang, Liu and Tong 2016 (cascaded normal regression); network, frame,
/// features and examples are our own (training/).
///
/// There are weights for noise that is independent from vertex to vertex, and others for depth
/// cameras, whose noise is correlated between neighbours. These are taken where the mesh carries
/// sigma, as scans do, or where its roughness falls slowly from pass to pass.
///
/// Was trained on noise of 0.03 to 0.8 mean edge lengths (cameras: 0.12 to 1.4), on triangles of
/// nearly equal size; what it does beyond that is not known. A sphere, torus or box without noise
/// moves by less than 0.01 mean edge lengths (RMS). Equivariant to movements, mirroring and scale
/// up to rounding, which also decides on which side a face is seen whose surroundings lean to
/// neither. Normals that are there are computed anew; sigma stays, which is on the safe side; all
/// else stays. On error or cancellation `mesh` is unchanged. O(#T).
/// Errors: invalid_argument, bad_geometry, cancelled.
Result<SmoothingReport> smooth_auto(TriangleMesh& mesh, const AutoParams& params = {},
                                    const Context& context = {});

}  // namespace burnish
