#include "burnish/smoothing/grid_row.h"

#include <gtest/gtest.h>

#include <cmath>

#include "burnish/base/random.h"

namespace burnish {
namespace {

constexpr std::size_t kWidth = 37, kHeight = 5;

/// A wavy grid whose places are rounded to `step`: the coarser, the more ties and symmetric rings.
std::vector<Vec3f> wavy_grid(double step, std::uint64_t seed) {
  std::vector<Vec3f> points;
  Random random(seed);
  for (std::size_t i = 0; i < kWidth * kHeight; ++i) {
    const double x = 0.003 * static_cast<double>(i % kWidth);
    const double y = 0.003 * static_cast<double>(i / kWidth);
    const double z = 1 + 0.0015 * random.normal();
    points.push_back(Vec3f(Vec3d{x, y, step > 0 ? std::round(z / step) * step : z}));
  }
  return points;
}

TEST(GridRow, IsTheSameFourPixelsAtATimeAndOneByOne) {
  for (const double step : {0.0, 0.001, 0.003, 1.0}) {
    const std::vector<Vec3f> points = wavy_grid(step, 3);
    Planes now;
    now.resize(kWidth, kHeight);
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        now.row(axis, i / kWidth)[i % kWidth] = double{points[i][axis]};
      }
    }
    const Equation1 weigh(points);
    Random random(9);
    for (const double hold : {0.0, 0.4}) {
      Planes grouped, single;
      grouped.resize(kWidth, kHeight);
      single.resize(kWidth, kHeight);
      for (std::size_t y = 1; y + 1 < kHeight; ++y) {
        std::vector<std::uint8_t> masks(kWidth + Planes::kLanes, 0);
        for (std::size_t x = 1; x + 1 < kWidth; ++x) {
          const std::uint8_t regular[] = {0, 0b11111111, 0b11011011, 0b01111110};
          const std::uint64_t chance = random.below(8);
          masks[x] = chance < 4 ? regular[chance] : static_cast<std::uint8_t>(random.below(256));
        }
        move_row(now, grouped, masks.data(), y, kWidth, weigh, hold);
        move_one_by_one(now, single, masks.data(), y, kWidth, weigh, hold);
        for (std::size_t x = 0; x < kWidth; ++x) {
          for (std::size_t axis = 0; axis < 3; ++axis) {
            ASSERT_EQ(grouped.row(axis, y)[x], single.row(axis, y)[x])
                << "pixel " << x << ", " << y << ", step " << step;
          }
          if (masks[x] == 0) {
            EXPECT_EQ(single.row(2, y)[x], now.row(2, y)[x]);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace burnish
