#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "burnish/base/context.h"

namespace burnish {

/// Random images of zero mean, one value per pixel, for the noise of a depth camera.
struct ImageNoise {
  std::vector<float> white;   ///< variance 1, independent from pixel to pixel
  std::vector<float> smooth;  ///< variance 1 - kWhiteShare, correlated between neighbours
  std::vector<float>
      loss;  ///< variance 1, correlated over about a pixel, independent of the others
};

/// The share of the variance of Kinect noise that is white. sqrt(kWhiteShare) white + smooth has
/// variance 1 and correlation .58, .38, .25, .20, .15 at 1, 2, 3, 4 and 6 pixels. Measured on a
/// real frame with known truth (the Pyramid of Zhang et al. 2021, Mesh-TGV): .58, .37, .25, .21,
/// .165.
inline constexpr double kWhiteShare = 0.32;

/// Draws the noise of one image. The value of a pixel depends on (seed, stream, width, height) and
/// on where it is, not on the number of threads. None where the context was cancelled.
std::optional<ImageNoise> draw_image_noise(std::uint32_t width, std::uint32_t height,
                                           std::uint64_t seed, std::uint64_t stream,
                                           const Context& context);

}  // namespace burnish
