#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "burnish/base/context.h"

namespace burnish {

/// Random images of zero mean, one value per pixel, for the noise of a depth camera.
struct ImageNoise {
  std::vector<float> white;   ///< variance 1, independent from pixel to pixel
  std::vector<float> smooth;  ///< variance 1 - kWhiteShare, correlated between neighbours as
                              ///< core/noise_correlation.h says
  // Variance 1, correlated over two pixels, independent of all others:
  std::vector<float> patches;
  std::vector<float> shift_x;
  std::vector<float> shift_y;
};

/// Draws the noise of one image. The value of a pixel depends on (seed, stream, width, height) and
/// on where it is, not on the number of threads. None where the context was cancelled.
std::optional<ImageNoise> draw_image_noise(std::uint32_t width, std::uint32_t height,
                                           std::uint64_t seed, std::uint64_t stream,
                                           const Context& context);

}  // namespace burnish
