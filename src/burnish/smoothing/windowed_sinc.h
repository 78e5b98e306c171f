#pragma once

#include "burnish/base/schema.h"
#include "burnish/smoothing/smoothing.h"

namespace burnish {

struct WindowedSincParams {
  int iterations = 20;     ///< the degree of the filter
  double pass_band = 0.1;  ///< frequency up to which all stays, 0 to 2
  BoundaryRule boundary = BoundaryRule::fixed;

  static const Schema<WindowedSincParams>& schema();
};

/// Low-pass smoothing with a sharp cut-off (Taubin, Zhang and Golub 1996). The filter
///     f(K) = sum_n w_n c_n T_n(I - K / 2),  c_0 = theta / pi,  c_n = 2 sin(n theta) / (n pi)
/// with K p = p - mean of the one-ring, T_n the Chebyshev polynomials, theta = acos(1 - k_PB / 2),
/// and Hamming's window w_n = 0.54 + 0.46 cos(n pi / (N + 1)), is applied once; N is `iterations`
/// and k_PB `pass_band`, with the meaning that they have in VTK. Frequencies k (eigenvalues of K, 0
/// to 2) above the pass band are cut off within about 20 / N of an angle acos(1 - k / 2).
///
/// As in the paper the window's blur is made up for by a greater theta, the first one with
/// f(k_PB) = 1. Beyond the paper, f is then divided by f(0): a window makes that differ from 1 by
/// up to 1 %, by which a mesh would be scaled about the origin of its coordinates. Small degrees
/// with wide pass bands cannot be had and leave the mesh as it is.
///
/// Does not shrink; blurs features; evens the triangles. boundary: along_boundary filters boundary
/// loops as curves. A smoothing weight scales the vertex's row of K: pinned vertices stay, and what
/// is around them adapts. Normals that are there are computed anew, all else stays, also sigma:
/// frequencies in the pass band keep all their noise, so that how much is averaged away depends on
/// its spectrum; to claim nothing is on the safe side. O(iterations * #T). Errors:
/// invalid_argument, bad_geometry, cancelled; `mesh` is then unchanged.
Result<SmoothingReport> smooth_windowed_sinc(TriangleMesh& mesh,
                                             const WindowedSincParams& params = {},
                                             const Context& context = {});

}  // namespace burnish
