#pragma once

#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/schema.h"
#include "burnish/core/depth_frame.h"

namespace burnish {

/// A point of a surface, as a camera sees it: in the camera's axes, m.
struct SurfacePixel {
  Vec3f position;   ///< z = 0: nothing is known of this pixel
  float sigma = 0;  ///< one standard deviation across the surface, of the random error
  Vec3f normal;     ///< unit length, towards the camera; 0: unknown, the pixel is not compared
  float bias = 0;   ///< the same of the systematic error, which neighbours share
};

/// What registration looks at: what one camera saw, or what a model looks like from one place.
struct SurfaceView {
  Camera camera;
  std::vector<SurfacePixel> pixels;  ///< width * height, row by row
  double normal_pixels = 162;        ///< about so many neighbours share the error of their normals
};

struct SurfaceViewParams {
  int window = 4;             ///< radius of the normals' window, pixels
  double distortion = 0.002;  ///< systematic error of 1/z, 1/m

  static const Schema<SurfaceViewParams>& schema();
};

/// A depth frame as registration looks at it. In units of one over the depth, in which planes stay
/// planes and a triangulating sensor errs alike everywhere, the slope along a row is the mean of
/// the central differences over `window` pixels to either side on 2 window + 1 rows, along a column
/// likewise; pixels whose row or column is bent by more than the noise and what a surface tilted by
/// 80 degrees explains have no normal, nor have those seen at 80 degrees or more.
///   sigma = axial(z, theta) cos(theta), the sensor's noise along the ray seen through the normal;
///   bias = distortion z^2 cos(theta): calibration leaves a low-frequency distortion of about half
///   a disparity step (Herrera, Kannala and Heikkila 2012; Teichman, Miller and Thrun 2013).
///   normal_pixels = 2 (2 window + 1)^2: the window, and what the noise itself is correlated over.
/// Depths outside the sensor's range are unknown. The frame's pose is not looked at. O(#pixels).
/// Errors: invalid_argument, bad_geometry, cancelled.
Result<SurfaceView> surface_view(const DepthFrame& frame, const SurfaceViewParams& params = {},
                                 const Context& context = {});

/// The same into a view that is there: nothing is allocated for its pixels where it has held a
/// frame of as many before. On error it is of no meaning.
Result<void> surface_view_into(const DepthFrame& frame, const SurfaceViewParams& params,
                               const Context& context, SurfaceView& view);

/// Whether the camera is sound and there is a pixel for each of its places. Errors: bad_geometry.
Result<void> check(const SurfaceView& view);

}  // namespace burnish
