#include "burnish/report/shade.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace burnish {
namespace {

/// The light of a code between 0 and 255.
double decode(double code) {
  const double c = code / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// sRGB both ways without a power for every sample of a picture.
struct Codes {
  static constexpr std::size_t kParts = 4096;  ///< of [0, 1]; none holds more than two limits

  std::array<double, 256> light;   ///< of each code
  std::array<double, 256> limits;  ///< limits[c]: from this light on the nearest code exceeds c
  std::array<std::uint8_t, kParts + 1> first;  ///< the code at the beginning of each part

  Codes() {
    for (std::size_t code = 0; code < 256; ++code) {
      light[code] = decode(static_cast<double>(code));
      limits[code] = code < 255 ? decode(static_cast<double>(code) + 0.5) : 2;
    }
    std::uint8_t code = 0;
    for (std::size_t part = 0; part <= kParts; ++part) {
      while (static_cast<double>(part) / kParts >= limits[code]) ++code;
      first[part] = code;
    }
  }

  std::uint8_t encode(double value) const {
    const double c = std::clamp(value, 0.0, 1.0);
    std::uint8_t code = first[static_cast<std::size_t>(c * kParts)];
    while (c >= limits[code]) ++code;
    return code;
  }
};

const Codes& codes() {
  static const Codes table;
  return table;
}

/// Linear sRGB of a colour in OKLab (Ottosson 2020).
Light from_oklab(double lightness, double a, double b) {
  const double l = lightness + 0.3963377774 * a + 0.2158037573 * b;
  const double m = lightness - 0.1055613458 * a - 0.0638541728 * b;
  const double s = lightness - 0.0894841775 * a - 1.2914855480 * b;
  const double l3 = l * l * l, m3 = m * m * m, s3 = s * s * s;
  return {4.0767416621 * l3 - 3.3077115913 * m3 + 0.2309699292 * s3,
          -1.2684380046 * l3 + 2.6097574011 * m3 - 0.3413193965 * s3,
          -0.0041960863 * l3 - 0.7034186147 * m3 + 1.7076147010 * s3};
}

}  // namespace

Light linear(const Color& color) {
  const auto& light = codes().light;
  return {light[color[0]], light[color[1]], light[color[2]]};
}

Color srgb(const Light& light) {
  const Codes& table = codes();
  return {table.encode(light.x), table.encode(light.y), table.encode(light.z), 255};
}

Light lighting(const Vec3d& normal, const Vec3d& ray) {
  static const Vec3d kKey = normalized(Vec3d{-0.60, -0.66, -0.46});
  static const Vec3d kFill = normalized(Vec3d{0.90, 0.10, -0.42});
  constexpr Light kWarm{1.0, 0.965, 0.915}, kCool{0.86, 0.93, 1.0};
  const Vec3d n = dot(normal, ray) > 0 ? -normal : normal;
  const double key = std::max(0.0, dot(n, kKey)), fill = std::max(0.0, dot(n, kFill));
  const double sky = 0.5 - 0.5 * n.y, camera = std::max(0.0, -dot(n, ray));
  return (0.78 * key + 0.10 * camera) * kWarm + (0.03 + 0.15 * sky + 0.15 * fill) * kCool;
}

Color color_of(double t) {
  if (!std::isfinite(t)) return {128, 128, 128, 255};
  // Hue and chroma at equal steps of lightness: blue, teal, green, yellow.
  static constexpr std::array<std::array<double, 2>, 5> kAb{
      {{0.01, -0.13}, {-0.045, -0.075}, {-0.10, 0.01}, {-0.10, 0.10}, {-0.03, 0.16}}};
  const double x = std::clamp(t, 0.0, 1.0) * (kAb.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(x), kAb.size() - 2);
  const double f = x - static_cast<double>(i);
  return srgb(from_oklab(0.30 + 0.62 * std::clamp(t, 0.0, 1.0),
                         kAb[i][0] * (1 - f) + kAb[i + 1][0] * f,
                         kAb[i][1] * (1 - f) + kAb[i + 1][1] * f));
}

}  // namespace burnish
