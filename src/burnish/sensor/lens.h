#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "burnish/core/depth_frame.h"

namespace burnish {

/// How a lens departs from a pinhole: Brown's model with a rational radial part (Claus and
/// Fitzgibbon 2005; OpenCV's first eight coefficients). A ray (x, y, 1) is seen where a pinhole
/// sees
///   x' = x d + 2 p1 x y + p2 (r2 + 2 x2),  y' = y d + 2 p2 x y + p1 (r2 + 2 y2),
///   d = (1 + k1 r2 + k2 r4 + k3 r6) / (1 + k4 r2 + k5 r4 + k6 r6)
struct Lens {
  std::array<double, 6> k{};
  double p1 = 0, p2 = 0;

  /// x' and y', and 0.
  Vec3d bend(double x, double y) const;
};

/// Which pixel of an image taken through `lens` is nearest to where a pinhole of the same camera
/// sees each of its pixels, row by row; width * height where it is out of the image.
std::vector<std::uint32_t> undistortion(const Camera& camera, const Lens& lens);

}  // namespace burnish
