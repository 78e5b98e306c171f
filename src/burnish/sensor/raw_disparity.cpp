#include "burnish/sensor/raw_disparity.h"

namespace burnish {
namespace {

constexpr std::uint16_t kNoDisparity = 2047;
constexpr double kFarthest = 10;       ///< m
constexpr double kStepsPerPixel = 4;   ///< of 1280 x 1024
constexpr double kHalfWindow = 0.375;  ///< pixels
constexpr double kMetre = 100;         ///< in the device's units

}  // namespace

double depth_of_disparity(std::uint16_t raw, const ZeroPlane& plane) {
  if (raw >= kNoDisparity) return 0;
  const double shift = (raw - kStepsPerPixel * plane.constant_shift) / kStepsPerPixel - kHalfWindow;
  const double m = shift * plane.reference_pixel_size;
  const double z =
      (m * plane.reference_distance / (plane.emitter_distance - m) + plane.reference_distance) /
      kMetre;
  return z > 0 && z <= kFarthest ? z : 0;
}

Camera camera_of(const ZeroPlane& plane) {
  const double f = plane.reference_distance / (2 * plane.reference_pixel_size);
  return {640, 480, f, f, 320, 240};
}

}  // namespace burnish
