#pragma once

#include <cmath>
#include <functional>
#include <optional>

#include "burnish/base/random.h"
#include "burnish/core/depth_frame.h"

namespace burnish::test {

/// A Kinect-like camera of a quarter of the size, at the origin and looking along +z.
inline DepthFrame empty_frame(std::uint32_t width = 160, std::uint32_t height = 120) {
  DepthFrame frame;
  frame.camera = {width, height, 146, 146, (width - 1) / 2.0, (height - 1) / 2.0};
  frame.depth.assign(std::size_t{width} * height, 0);
  frame.noise = {.z0 = 0.4,
                 .c0 = 0.0012,
                 .c1 = 0,
                 .c2 = 0.0019,
                 .grazing = 0,
                 .power = 0,
                 .grazing_from = 0,
                 .pixels = 0.8,
                 .pixels_grazing = 0.035,
                 .metres = 0,
                 .min_depth = 0.4,
                 .max_depth = 4.5};
  return frame;
}

/// Depth along +z that the ray through a pixel (direction with z = 1, camera axes) meets; none: 0.
using DepthOf = std::function<double(const Vec3d& direction)>;

/// Fills the frame, with white noise of `noise` times the sensor's axial deviation.
inline void fill(DepthFrame& frame, const DepthOf& depth_of, double noise = 0,
                 std::uint64_t seed = 1) {
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    const double u = static_cast<double>(i % frame.camera.width);
    const double v = static_cast<double>(i / frame.camera.width);
    const double z = depth_of(frame.camera.unproject(u, v, 1));
    Random random(seed, i);
    const double error = noise * frame.noise.axial(z, 0) * random.normal();
    frame.depth[i] = z > 0 ? static_cast<float>(z + error) : 0;
  }
}

/// The plane n . x = d.
inline DepthOf plane(const Vec3d& n, double d) {
  return [n, d](const Vec3d& direction) {
    const double slope = dot(n, direction);
    return slope != 0 && d / slope > 0 ? d / slope : 0;
  };
}

/// The near side of a ball.
inline DepthOf ball(const Vec3d& centre, double radius) {
  return [centre, radius](const Vec3d& direction) {
    const double a = squared_norm(direction), b = dot(direction, centre);
    const double discriminant = b * b - a * (squared_norm(centre) - radius * radius);
    return discriminant < 0 ? 0 : (b - std::sqrt(discriminant)) / a;
  };
}

}  // namespace burnish::test
