#pragma once

#include <span>
#include <vector>

#include "burnish/core/point_cloud.h"
#include "burnish/points/surface_cells.h"

namespace burnish {

/// Several clouds as one source of measurements, in the first one's frame.
class CloudMeasurements : public MeasurementSource {
 public:
  explicit CloudMeasurements(std::span<const PointCloud> clouds);

  /// The median over all points of the distance between neighbouring rays where they meet the
  /// surface, m; of unorganized clouds the distance to the nearest other point. 0: no points.
  double typical_footprint() const;
  /// The median sigma over all points, m; 0 where a cloud has none.
  double typical_sigma() const;
  /// Whether every cloud has a sigma.
  bool has_sigma() const { return has_sigma_; }
  /// Whether every cloud has a noise.
  bool has_precision() const override { return has_noise_; }
  std::size_t points() const;  ///< with a position

  /// How measurements are to be weighed; see merge_cells.h.
  struct Weighing {
    double spacing = 0, registration = 0, correlation = 0;
  };
  void weigh(const Weighing& weighing) { weighing_ = weighing; }
  /// Only every step-th row and column of grids; all points of other clouds.
  void thin(std::size_t step) { step_ = step; }

  /// Standard deviation of a measurement with that sigma under the present weighing, m.
  double deviation(double sigma) const;
  Measurement typical() const;

  std::size_t lists() const override { return clouds_.size(); }
  std::size_t size(std::size_t list) const override { return clouds_[list].positions.size(); }
  bool counts(std::size_t list, std::size_t i) const override;
  Measurement read(std::size_t list, std::size_t i) const override;

 private:
  struct View {
    Vec3d shift;       ///< to the first cloud's frame
    Vec3d eye;         ///< in the cloud's own
    double pitch = 0;  ///< between the rays of neighbouring pixels, rad; 0: unorganized
    std::vector<std::uint8_t> outlined;  ///< pixels near outlines; of grids
  };
  double sigma(std::size_t list, std::size_t i) const;

  std::span<const PointCloud> clouds_;
  std::vector<View> views_;
  bool has_sigma_ = true, has_noise_ = true;
  Weighing weighing_;
  std::size_t step_ = 1;
};

}  // namespace burnish
