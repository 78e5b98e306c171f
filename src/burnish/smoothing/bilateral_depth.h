#pragma once

#include "burnish/base/context.h"
#include "burnish/base/facts.h"
#include "burnish/base/schema.h"
#include "burnish/core/depth_frame.h"

namespace burnish {

struct BilateralDepthParams {
  double spatial = 3;   ///< pixels
  double range = 1.25;  ///< standard deviations of the sensor's noise at the pixel's depth
  int iterations = 2;
  bool symmetric = true;  ///< false: every neighbour by itself, as in the paper

  static const Schema<BilateralDepthParams>& schema();
};

/// What a filter did to a depth frame.
struct BilateralDepthReport {
  int iterations = 0;
  std::size_t pixels = 0;  ///< with a depth
  double rms_move = 0;     ///< over these, along the camera's z, m
  double max_move = 0;     ///< m
  double mean_share = 0;   ///< of each pixel's sigma that is left

  Facts facts() const;
};

/// Bilateral filter of a depth image (Tomasi and Manduchi 1998, Eq. 5), as depth cameras have it
/// done since Newcombe et al. 2011, whose range width however is one length for the whole image.
/// Here it follows the sensor: `range` times noise.axial at the pixel's depth (times its
/// noise_share). What is averaged is inverse depth w = 1/z, in which planes are linear over the
/// image and the noise of a structured light camera is the same at every depth:
///     w' = w + sum_j g_j (w_j - w) / sum_j g_j,   over the pixels within 2 * spatial, itself too
///     g_j = exp(-|u_j - u|^2 / (2 spatial^2)) exp(-(w_j - w)^2 / (2 s^2)),  s = range sigma_z /
///     z^2
/// With `symmetric` a pixel and the one opposite to it count together or not at all: both get
/// exp(-((w_j - w)^2 + (w_k - w)^2) / (2 s^2)), and none where the other is missing. Then a plane
/// stays where it is, however tilted, up to the last pixel before a depth edge; without, its rim
/// bends towards its middle by up to the noise.
///
/// Missing pixels stay missing and count for nothing; so does what lies outside of the image. At
/// the defaults a step of 5 standard deviations keeps about nine tenths of its height and one of 1
/// loses four fifths (white noise); a greater range smooths more and takes of the greater step,
/// too. A sensor without noise has its depth left as it is.
///
/// sigma_share follows, on the safe side. Noise of a depth camera is shared between neighbours
/// (core/noise_correlation.h): a mean of n = (sum g)^2 / sum g^2 pixels leaves of its variance
///     G = sum of the shares, each / (1 + (n - 1) / (4 pi blur^2)), the white one / n,
/// and as neighbours that err like the pixel itself count for more, 1 / (1 + range^2) of its own
/// error stays at least: sigma' = sigma (own + (1 - own) sqrt(G)). White noise alone would go
/// down to about sigma * sqrt(own^2 + 1/n); counting on that would promise a third of what is true.
/// Passes after the first are not counted. noise_share and observations stay: they are of the
/// measurement, and a bound on a smoothing has to know of the depths before this (the pipeline
/// refuses to bound what was filtered).
///
/// O(iterations * #pixels * spatial^2). Errors: invalid_argument, bad_geometry, cancelled; `frame`
/// is then unchanged.
Result<BilateralDepthReport> smooth_bilateral_depth(DepthFrame& frame,
                                                    const BilateralDepthParams& params = {},
                                                    const Context& context = {});

}  // namespace burnish
