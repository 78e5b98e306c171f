#pragma once

#include <cstdint>
#include <span>

#include "burnish/base/schema.h"
#include "burnish/core/attributes.h"
#include "burnish/triangulation/fan_cloud.h"

namespace burnish {

/// What counts for how much in a point's information. The sources name what counts; the terms'
/// exact form and all numbers are our own.
struct InformationWeights {
  double distance_weight = 1;
  double normal_weight = 1;
  double crowding_weight = 0.3;
  double color_weight = 1;
  double outline_weight = 2;
  double noise_sigmas = 3;

  static const Schema<InformationWeights>& schema();
};

/// How much a cloud would lose with one of its points, after Linsen and Prautzsch 2003 (only the
/// abstract could be read; the formula is our own). With the rim q_i of the fan of p, m the mean of
/// |q_i - p|, and n the fan's normal:
///
///     S(p) = distance_weight * d / m,  d = |n . (p - mean q_i)| - noise_sigmas * sigma_p, or 0
///          + normal_weight   * mean of 1 - |n_p . n_i|
///          + crowding_weight * m / M
///          + color_weight    * |c_p - mean c_i|, 0 to 1
///          + outline_weight  * the distance of p from the segment that closes its gap / M
///
/// sigma_p is what the sensor may be off, where that is known: what it may have made up is no
/// information. n_p, n_i are the points' own normals, M a length: what is usual for m. The last
/// term, of open fans alone, is how far the outline would move; of several gaps the largest counts.
/// Of a flat and even cloud only the third is not 0. A point without a fan counts as one whose
/// distance is m and whose normal is across; one in the place of another has no information.
class PointInformation {
 public:
  /// `normals`: one a point, of unit length or 0 where unknown. Colors and sigma are those of
  /// `attributes`, where it has them. Both must stay.
  PointInformation(const InformationWeights& weights, double usual_edge,
                   std::span<const Vec3f> normals, const Attributes& attributes)
      : weights_(weights),
        usual_edge_(usual_edge),
        normals_(normals),
        colors_(attributes.colors),
        sigma_(attributes.sigma) {}

  /// S of an active point; depends on its fan and on what is known of the points in it. O(k).
  double operator()(const FanCloud& fans, std::uint32_t p) const;

 private:
  double color_change(std::span<const std::uint32_t> rim, std::uint32_t p) const;

  InformationWeights weights_;
  double usual_edge_;
  std::span<const Vec3f> normals_;
  std::span<const Color> colors_;
  std::span<const float> sigma_;
};

/// The mean distance of a point from the rim of its fan; 0 where it has none.
double mean_fan_edge(const FanCloud& fans, std::uint32_t p);

}  // namespace burnish
