#include "burnish/sensor/lens.h"

#include <cmath>

namespace burnish {

Vec3d Lens::bend(double x, double y) const {
  const double r2 = x * x + y * y;
  const double radial =
      (1 + r2 * (k[0] + r2 * (k[1] + r2 * k[2]))) / (1 + r2 * (k[3] + r2 * (k[4] + r2 * k[5])));
  return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
          y * radial + 2 * p2 * x * y + p1 * (r2 + 2 * y * y), 0};
}

std::vector<std::uint32_t> undistortion(const Camera& camera, const Lens& lens) {
  std::vector<std::uint32_t> sources;
  sources.reserve(std::size_t{camera.width} * camera.height);
  for (std::uint32_t v = 0; v < camera.height; ++v) {
    for (std::uint32_t u = 0; u < camera.width; ++u) {
      const Vec3d bent = lens.bend((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy);
      const double column = std::round(camera.fx * bent.x + camera.cx);
      const double row = std::round(camera.fy * bent.y + camera.cy);
      const bool seen = column >= 0 && row >= 0 && column < camera.width && row < camera.height;
      sources.push_back(seen ? static_cast<std::uint32_t>(row) * camera.width +
                                   static_cast<std::uint32_t>(column)
                             : camera.width * camera.height);
    }
  }
  return sources;
}

}  // namespace burnish
