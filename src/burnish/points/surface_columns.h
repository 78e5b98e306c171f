#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/result.h"
#include "burnish/base/vec3.h"

namespace burnish {

/// One measurement of a surface as merging weighs it.
struct Measurement {
  Vec3d position;
  Vec3f normal;             ///< unit length
  double weight = 1;        ///< for means
  double information = 1;   ///< for sigma, 1/m^2
  std::uint32_t count = 1;  ///< observations
};

/// Where measurements come from: list i has size(i) entries, of which `read` gives those that
/// count.
class MeasurementSource {
 public:
  virtual ~MeasurementSource() = default;
  virtual std::size_t lists() const = 0;
  virtual std::size_t size(std::size_t list) const = 0;
  virtual bool counts(std::size_t list, std::size_t i) const = 0;
  virtual Measurement read(std::size_t list, std::size_t i) const = 0;
};

/// A surface seen as six height fields, one for each direction of the axes. A measurement belongs
/// to the field of the axis nearest to its normal; a field is cut into square columns along its
/// axis and columns into cells, each the weighted mean of its measurements. Sorted by field, row,
/// column and height: what lies around a point within a row is one run of memory.
class SurfaceColumns {
 public:
  struct Cell {
    Vec3f position, normal;
    float weight = 0, information = 0;
    std::uint32_t count = 0;     ///< observations
    std::uint32_t measured = 0;  ///< measurements
  };

  /// Cells `across` wide and `along` deep (m). Sums are integers, so that the cells do not depend
  /// on the order of the measurements; weights count relative to `typical` and are limited to a
  /// thousand times more or less. Errors: invalid_argument where there are too many cells along an
  /// axis, cancelled.
  static Result<SurfaceColumns> build(const MeasurementSource& source, double across, double along,
                                      const Measurement& typical, const Context& context);

  const std::vector<Cell>& cells() const { return cells_; }
  /// The axis along whose columns cell i lies.
  std::size_t axis(std::size_t i) const { return keys_[i] >> (3 * kBits + 1); }

  /// Calls visit(cell, axis) for the cells whose columns come within `radius` of p, in the fields
  /// whose direction has a component of at least `least` along n.
  template <class Visit>
  void visit(const Vec3d& p, const Vec3d& n, double radius, double least, const Visit& visit) const;

 private:
  static constexpr int kBits = 20;  ///< of a row's, a column's and a layer's number
  static constexpr std::int64_t kHalf = std::int64_t{1} << (kBits - 1);

  struct Field {
    std::int64_t first_row = 0;
    std::vector<std::uint32_t> starts;  ///< of the rows' cells, one entry more than there are rows
  };
  struct Entry;

  static std::uint64_t key(std::size_t field, std::int64_t row, std::int64_t column,
                           std::int64_t layer) {
    const auto part = [](std::int64_t i) { return static_cast<std::uint64_t>(i + kHalf); };
    return (((field << kBits | part(row)) << kBits | part(column)) << kBits) | part(layer);
  }
  static std::int64_t floor_of(double x) { return static_cast<std::int64_t>(std::floor(x)); }

  Result<std::vector<Entry>> sorted_entries(const MeasurementSource& source,
                                            const Context& context);
  Cell mean_of(const MeasurementSource& source, std::span<const Entry> entries,
               const Measurement& typical) const;
  void index_rows();

  double across_ = 1, along_ = 1;
  std::vector<Cell> cells_;
  std::vector<std::uint64_t> keys_;
  std::array<Field, 6> fields_;
};

template <class Visit>
void SurfaceColumns::visit(const Vec3d& p, const Vec3d& n, double radius, double least,
                           const Visit& visit) const {
  for (std::size_t field = 0; field < fields_.size(); ++field) {
    const std::size_t axis = field / 2;
    if ((field % 2 == 0 ? n[axis] : -n[axis]) < least || fields_[field].starts.empty()) continue;
    const Field& rows = fields_[field];
    const double r = p[(axis + 1) % 3], c = p[(axis + 2) % 3];
    const std::int64_t row_end = rows.first_row + static_cast<std::int64_t>(rows.starts.size()) - 1;
    const std::int64_t from = std::max(rows.first_row, floor_of((r - radius) / across_));
    const std::int64_t to = std::min(row_end - 1, floor_of((r + radius) / across_));
    for (std::int64_t row = from; row <= to; ++row) {
      const std::size_t at = static_cast<std::size_t>(row - rows.first_row);
      const auto begin = keys_.begin() + rows.starts[at], end = keys_.begin() + rows.starts[at + 1];
      const auto first =
          std::lower_bound(begin, end, key(field, row, floor_of((c - radius) / across_), -kHalf));
      const std::uint64_t last = key(field, row, floor_of((c + radius) / across_), kHalf - 1);
      for (auto k = first; k != end && *k <= last; ++k) {
        visit(static_cast<std::uint32_t>(k - keys_.begin()), axis);
      }
    }
  }
}

}  // namespace burnish
