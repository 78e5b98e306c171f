#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/core/depth_frame.h"

namespace burnish {

/// A patch of what one frame saw: a plane n . x = h in camera coordinates, n of unit length and
/// away from the camera, so that h - n . x is the distance of x in front of it.
struct DepthPlane {
  float nx = 0, ny = 0, nz = 0, h = 0;  ///< h: m
  float weight = 0;                     ///< 1 / variance of h, in 1 / unit^2; 0: no plane
  float reach = 0;                      ///< m: how far in front and behind it tells of the surface
};

/// A depth frame as planes of 2 x 2, 4 x 4 and 8 x 8 pixels, so that a voxel meets the mean of all
/// pixels that look through it and not one of them alone (Williams 1983 does so with colours).
///
/// The mean is of 1 / z, in which planes are planes; a patch is one only where its four quarters
/// lie within what noise and a surface tilted by 75 degrees explain of each other. Its slope is
/// that of the means of 4 x 4 (8 x 8) pixels beside it. Its variance is the sensor's across the
/// surface,
///   (share axial(z, theta) cos(theta))^2 + (lateral(z, theta) sin(theta))^2,
/// times what the mean of so many pixels leaves of noise correlated as core/noise_correlation.h
/// says. Where there is no patch, single pixels stand in: at the edges of things. They are taken to
/// face the camera, and to tell a sixteenth.
class DepthPlanes {
 public:
  static constexpr int kLevels = 3;

  /// How distances are measured. `unit` is that of weights; reach is the larger of `least_reach`
  /// and `sigmas` standard deviations of a single pixel, but at most `most_reach`. m.
  struct Measure {
    double unit = 1, least_reach = 0, sigmas = 0, most_reach = 0;
  };

  /// Works on a frame that passes check(frame). False where cancelled. O(#pixels).
  [[nodiscard]] bool build(const DepthFrame& frame, const Measure& measure, const Context& context);

  const Camera& camera() const { return camera_; }

  /// The level whose patches are no wider than `footprint` pixels, 1 to kLevels.
  static int level_for(double footprint);

  /// What pixel (u, v) of the image sees: the plane of its patch of 2^level pixels or of the
  /// largest smaller one that there is. `is_edge` tells single pixels. Without a depth: weight 0.
  const DepthPlane& at(int level, std::uint32_t u, std::uint32_t v, bool& is_edge) const {
    for (; level >= 0; --level) {
      const Level& patches = levels_[static_cast<std::size_t>(level)];
      const DepthPlane& plane = patches.planes[(v >> level) * patches.width + (u >> level)];
      if (plane.weight > 0 || level == 0) {
        is_edge = level == 0;
        return plane;
      }
    }
    return levels_[0].planes[0];  // not reached
  }

 private:
  struct Level {
    std::size_t width = 0, height = 0;
    std::vector<float> inverse;      ///< mean of 1 / z, 1/m; 0: none
    std::vector<float> share;        ///< mean of the frame's sigma_share; empty: 1
    std::vector<DepthPlane> planes;  ///< of pixels: only where there is no patch of 2 x 2
  };
  struct Slope {
    double u = 0, v = 0;
    bool known = false;
  };
  /// What the noise model says of surfaces seen at one angle.
  struct Grazing {
    double axial = 0;    ///< more than seen at right angles, at a depth of 1 m
    double lateral = 0;  ///< at 1 m, more than at 0 m
  };

  void average(std::size_t level, std::size_t row);
  void fit(std::size_t level, std::size_t row);
  double jump(double inverse, double share, double pixels) const;
  Slope slope(std::size_t level, std::size_t x, std::size_t y) const;
  DepthPlane plane(double u, double v, double inverse, double share, const Slope& slope,
                   double kept) const;
  DepthPlane pixel_plane(std::uint32_t u, std::uint32_t v) const;

  Camera camera_;
  DepthNoise noise_;
  Measure measure_;
  std::vector<Grazing> grazing_;  ///< by the cosine of the angle
  std::array<Level, kLevels + 1> levels_;
};

/// What share of a pixel's variance the mean of side x side pixels keeps, their noise being
/// correlated as core/noise_correlation.h says.
double variance_of_mean(int side);

}  // namespace burnish
