#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "burnish/base/facts.h"
#include "burnish/base/result.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// How far vertices are from their measurements, in standard deviations of these. Computed for
/// itself, from the two meshes alone, in double: it shares nothing with what bounds a smoothing.
struct NoiseCertificate {
  double c = 0;                   ///< standard deviations that were allowed
  std::size_t vertices = 0;       ///< in all
  std::size_t invented = 0;       ///< of which there is no measurement: free
  std::size_t outside = 0;        ///< farther than c
  std::size_t at_bound = 0;       ///< farther than 0.99 c, but not than c
  double largest_ratio = 0;       ///< of a displacement to the deviation in its direction
  std::size_t worst = 0;          ///< the vertex that has it
  double worst_displacement = 0;  ///< m
  double worst_sigma = 0;         ///< the measurement's deviation in that direction, m
  bool round_regions = false;     ///< the mesh has but one sigma a vertex, regions are balls

  bool holds() const { return outside == 0; }
  Facts facts() const;
};

/// What a certificate cannot say, for those who rely on it.
inline constexpr const char* kNotCovered =
    "noise that neighbouring measurements share, bias of the sensor, errors of the poses";

/// The certificate in sentences, for the head of a file or a terminal.
std::vector<std::string> sentences(const NoiseCertificate& certificate);

/// Measures every vertex of `after` against its place and noise in `before` (sigma where there is
/// no noise). O(#V). Errors: invalid_argument where c is negative; bad_geometry where the two have
/// different numbers of vertices, or `before` has no noise and no sigma.
Result<NoiseCertificate> certify_noise_bound(const TriangleMesh& before, const TriangleMesh& after,
                                             double c);

}  // namespace burnish
