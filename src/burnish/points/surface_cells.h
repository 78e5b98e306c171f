#pragma once

#include <cstdint>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/result.h"
#include "burnish/points/column_index.h"
#include "burnish/points/precision.h"

namespace burnish {

/// One measurement of a surface as merging weighs it.
struct Measurement {
  Vec3d position;
  Vec3f normal;             ///< unit length
  double weight = 1;        ///< for means
  double information = 1;   ///< for sigma, 1/m^2
  Precision precision{};    ///< for the noise
  std::uint32_t count = 1;  ///< observations
};

/// Where measurements come from: list i has size(i) entries, of which some count.
class MeasurementSource {
 public:
  virtual ~MeasurementSource() = default;
  virtual std::size_t lists() const = 0;
  virtual std::size_t size(std::size_t list) const = 0;
  virtual bool counts(std::size_t list, std::size_t i) const = 0;
  virtual Measurement read(std::size_t list, std::size_t i) const = 0;
  virtual bool has_precision() const = 0;  ///< whether measurements have one
};

/// The weighted mean of the measurements in a cell.
struct SurfaceCell {
  Vec3f position, normal;
  float weight = 0, information = 0;
  std::uint32_t count = 0;     ///< observations
  std::uint32_t measured = 0;  ///< measurements
};

/// Cells with measurements in them, in the order of their index.
struct SurfaceCells {
  std::vector<SurfaceCell> cells;
  std::vector<std::array<float, 6>> precisions;  ///< one per cell, or none; xx yy zz xy yz zx
  ColumnIndex index;
};

/// Averages measurements in cells `across` wide and `along` deep (m). Sums are integers, so that
/// the cells do not depend on the order of the measurements; weights count relative to `typical`
/// and are limited to a thousand times more or less; so are precisions, to a million times more.
/// O(n log n). Errors: invalid_argument where there are too many cells along an axis, cancelled.
Result<SurfaceCells> average_in_cells(const MeasurementSource& source, double across, double along,
                                      const Measurement& typical, const Context& context);

}  // namespace burnish
