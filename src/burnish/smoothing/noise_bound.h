#pragma once

#include <cstddef>

#include "burnish/base/context.h"
#include "burnish/base/facts.h"
#include "burnish/base/schema.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

struct NoiseBoundParams {
  double c = 2;  ///< standard deviations that a vertex may be away from its measurement

  static const Schema<NoiseBoundParams>& schema();
};

/// What a bound did.
struct NoiseBoundReport {
  double largest_ratio = 0;  ///< of a vertex's displacement to its noise, now; at most c
  std::size_t put_back = 0;  ///< vertices that had left their region
  std::size_t free = 0;      ///< invented ones, of which there is no measurement

  Facts facts() const;
};

/// Whether `mesh` says how far its vertices may be off: by noise, or by sigma alone. Errors:
/// bad_geometry where it has neither, or where one is negative, not finite or without an axis.
Result<void> check_noise(const TriangleMesh& mesh);

/// Puts every vertex of `after` that has left the region in which its own measurement places it
/// back into it. `before` is the mesh of the measurements: the one that came into the smoothing. A
/// displacement d from there, a along the axis of the vertex's noise and b across it, has the ratio
///   r = sqrt((a / along)^2 + (b / across)^2);
/// the region is r <= c: thin across the ray of the sensor, long along it. Without noise it is the
/// ball |d| <= c sigma. Invented vertices are free.
///
/// A vertex with r > c goes to where its way leaves the region: before + (c / r) d. Measured in
/// standard deviations that is the nearest point of the region, and the way is the one that the
/// smoothing chose. It is taken so much shorter (by the rounding of a float at these coordinates)
/// that the position as it is stored is inside for sure.
///
/// Its sigma becomes (1 - t) of what it was and t = c / r of what the smoothing made it: a bound on
/// the error of such a mixture, however correlated its parts. Normals that are there are computed
/// anew. Noise stays that of the measurement. O(#V + #T). Errors: invalid_argument, bad_geometry
/// (also where the two are not of one size, or in different frames), cancelled; `after` is then
/// unchanged.
Result<NoiseBoundReport> bound_to_noise(const TriangleMesh& before, TriangleMesh& after,
                                        const NoiseBoundParams& params = {},
                                        const Context& context = {});

}  // namespace burnish
