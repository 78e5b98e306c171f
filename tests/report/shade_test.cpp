#include "burnish/report/shade.h"

#include <gtest/gtest.h>

#include <cmath>

#include "burnish/base/random.h"

namespace burnish {
namespace {

TEST(Shade, EveryCodeComesBack) {
  for (int code = 0; code < 256; ++code) {
    const auto c = static_cast<std::uint8_t>(code);
    EXPECT_EQ(srgb(linear({c, c, c, 255})), (Color{c, c, c, 255}));
  }
}

/// The standard's formula, unrounded.
double code_of(double light) {
  return 255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055);
}

TEST(Shade, GivesTheNearestCode) {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const double u = random.uniform();
    const double light = i % 2 == 0 ? u : 0.01 * u;  // codes are dense in the dark
    // The two pieces of the formula meet at 0.04045 within 1e-5 of a code.
    EXPECT_LE(std::abs(srgb({light, 0, 0})[0] - code_of(light)), 0.5 + 1e-5) << light;
  }
}

TEST(Shade, ClampsWhatIsTooDarkOrTooBright) {
  EXPECT_EQ(srgb({-1, 0, 0.0031308 / 12.92 / 10}), (Color{0, 0, 0, 255}));
  EXPECT_EQ(srgb({1, 1.0001, 1e300}), (Color{255, 255, 255, 255}));
}

}  // namespace
}  // namespace burnish
