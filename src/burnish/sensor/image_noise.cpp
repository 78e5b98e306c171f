#include "burnish/sensor/image_noise.h"

#include <cmath>

#include "burnish/base/parallel.h"
#include "burnish/base/random.h"
#include "burnish/core/noise_correlation.h"

namespace burnish {
namespace {

/// A Gaussian blur of standard deviation s, cut off at 3 s: weights decay^(i^2), decay = exp(-1/(2
/// s^2)). (The decay is written out because compilers that evaluate exp differ in its last digit.)
struct Blur {
  int radius;  ///< px
  double decay;
};
constexpr Blur kFine{3, 0.60653065971263342};     // s = 1 px
constexpr Blur kPatch{6, 0.88249690258459546};    // s = 2 px
constexpr Blur kCoarse{15, 0.98019867330675525};  // s = 5 px
static_assert(kFineBlur == 1 && kCoarseBlur == 5);

constexpr std::size_t kRowsAtOnce = 8;

struct Image {
  std::size_t width, height;
  std::vector<float> values;

  Image(std::size_t w, std::size_t h) : width(w), height(h), values(w * h) {}
  float* row(std::size_t y) { return values.data() + y * width; }
  const float* row(std::size_t y) const { return values.data() + y * width; }
};

/// Draws independent normal values; those of one row are one stream of random numbers.
bool fill_white(Image& image, std::uint64_t seed, std::uint64_t stream, const Context& context) {
  return parallel_for(
      context, image.height,
      [&](IndexRange rows) {
        for (std::size_t y = rows.begin; y < rows.end; ++y) {
          Random random(seed, stream << 32 | y);
          for (std::size_t x = 0; x < image.width; ++x) {
            image.row(y)[x] = static_cast<float>(random.normal());
          }
        }
      },
      kRowsAtOnce);
}

/// The weights of a blur, scaled so that the sum of squares is 1: blurred white noise then keeps
/// its variance.
std::vector<double> kernel_of(const Blur& blur) {
  std::vector<double> half{1};
  double ratio = blur.decay;  // of neighbouring weights: decay^(2 i + 1)
  for (int i = 0; i < blur.radius; ++i) {
    half.push_back(half.back() * ratio);
    ratio *= blur.decay * blur.decay;
  }
  std::vector<double> kernel(half.rbegin(), half.rend());
  kernel.insert(kernel.end(), half.begin() + 1, half.end());
  double squares = 0;
  for (const double weight : kernel) squares += weight * weight;
  for (double& weight : kernel) weight /= std::sqrt(squares);
  return kernel;
}

/// Filters along rows and gives the transposed image, narrower by the kernel.
bool blur_transposed(const Image& from, const std::vector<double>& kernel, Image& to,
                     const Context& context) {
  return parallel_for(
      context, from.height,
      [&](IndexRange rows) {
        for (std::size_t y = rows.begin; y < rows.end; ++y) {
          const float* row = from.row(y);
          for (std::size_t x = 0; x < to.height; ++x) {
            double sum = 0;
            for (std::size_t i = 0; i < kernel.size(); ++i) sum += kernel[i] * row[x + i];
            to.row(x)[y] = static_cast<float>(sum);
          }
        }
      },
      kRowsAtOnce);
}

/// Noise of variance 1 that was blurred, drawn with a margin so that the image's
/// edge is like its middle.
bool fill_blurred(Image& image, const Blur& blur, std::uint64_t seed, std::uint64_t stream,
                  const Context& context) {
  const std::vector<double> kernel = kernel_of(blur);
  const std::size_t margin = kernel.size() - 1;
  Image white(image.width + margin, image.height + margin);
  Image half(white.height, image.width);
  return fill_white(white, seed, stream, context) &&
         blur_transposed(white, kernel, half, context) &&
         blur_transposed(half, kernel, image, context);
}

}  // namespace

std::optional<ImageNoise> draw_image_noise(std::uint32_t width, std::uint32_t height,
                                           std::uint64_t seed, std::uint64_t stream,
                                           const Context& context) {
  Context quiet = context;  // drawing is a small part of taking a picture
  quiet.sink = nullptr;
  constexpr std::uint64_t kImages = 6;
  std::uint64_t next = kImages * stream;
  Image white(width, height), fine(width, height), coarse(width, height);
  Image patches(width, height), shift_x(width, height), shift_y(width, height);
  if (!fill_white(white, seed, next++, quiet)) return std::nullopt;
  const std::pair<Image*, const Blur*> blurred[] = {{&fine, &kFine},
                                                    {&coarse, &kCoarse},
                                                    {&patches, &kPatch},
                                                    {&shift_x, &kPatch},
                                                    {&shift_y, &kPatch}};
  for (const auto& [image, blur] : blurred) {
    if (!fill_blurred(*image, *blur, seed, next++, quiet)) return std::nullopt;
  }
  for (std::size_t i = 0; i < fine.values.size(); ++i) {
    fine.values[i] = static_cast<float>(std::sqrt(kFineShare) * fine.values[i] +
                                        std::sqrt(kCoarseShare) * coarse.values[i]);
  }
  return ImageNoise{std::move(white.values), std::move(fine.values), std::move(patches.values),
                    std::move(shift_x.values), std::move(shift_y.values)};
}

}  // namespace burnish
