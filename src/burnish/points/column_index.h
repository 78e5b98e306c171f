#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "burnish/base/vec3.h"

namespace burnish {

/// A surface seen as six height fields, one for each direction of the axes. A point belongs to the
/// field of the axis nearest to its normal; a field is cut into square columns along its axis, and
/// columns into cells. Sorted by field, row, column and height, what lies around a point within a
/// row of columns is one run of memory.
class ColumnIndex {
 public:
  static constexpr int kBits = 20;  ///< of a row's, a column's and a layer's number
  static constexpr std::int64_t kHalf = std::int64_t{1} << (kBits - 1);

  /// The field of a normal: 2 * axis, one more for the negative direction.
  static std::size_t field_of(const Vec3f& n) {
    const Vec3f size{std::abs(n.x), std::abs(n.y), std::abs(n.z)};
    const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return 2 * axis + (n[axis] < 0 ? 1 : 0);
  }
  /// The place in the order of a cell; numbers within [-kHalf, kHalf).
  static std::uint64_t key(std::size_t field, std::int64_t row, std::int64_t column,
                           std::int64_t layer) {
    const auto part = [](std::int64_t i) { return static_cast<std::uint64_t>(i + kHalf); };
    return (((field << kBits | part(row)) << kBits | part(column)) << kBits) | part(layer);
  }
  static std::int64_t floor_of(double x) { return static_cast<std::int64_t>(std::floor(x)); }

  ColumnIndex() = default;
  /// Of columns `across` wide (m); `keys` must rise.
  ColumnIndex(std::vector<std::uint64_t> keys, double across);

  std::size_t size() const { return keys_.size(); }
  double across() const { return across_; }
  std::uint64_t key(std::size_t i) const { return keys_[i]; }
  std::size_t axis(std::size_t i) const { return keys_[i] >> (3 * kBits + 1); }
  bool same_column(std::size_t i, std::size_t j) const {
    return keys_[i] >> kBits == keys_[j] >> kBits;
  }

  /// The entries `kept`, which must rise, as an index of their own.
  ColumnIndex subset(std::span<const std::uint32_t> kept) const;

  /// Calls visit(i, axis) for the entries whose columns come within `radius` of p, in the fields
  /// whose direction has a component of at least `least` along n.
  template <class Visit>
  void visit(const Vec3d& p, const Vec3d& n, double radius, double least, const Visit& visit) const;

 private:
  struct Field {
    std::int64_t first_row = 0;
    std::vector<std::uint32_t> starts;  ///< of the rows, one entry more than there are rows
  };

  double across_ = 1;
  std::vector<std::uint64_t> keys_;
  std::array<Field, 6> fields_;
};

template <class Visit>
void ColumnIndex::visit(const Vec3d& p, const Vec3d& n, double radius, double least,
                        const Visit& visit) const {
  for (std::size_t field = 0; field < fields_.size(); ++field) {
    const std::size_t axis = field / 2;
    if ((field % 2 == 0 ? n[axis] : -n[axis]) < least || fields_[field].starts.empty()) continue;
    const Field& rows = fields_[field];
    const double r = p[(axis + 1) % 3], c = p[(axis + 2) % 3];
    const std::int64_t row_end = rows.first_row + static_cast<std::int64_t>(rows.starts.size()) - 1;
    const std::int64_t from = std::max(rows.first_row, floor_of((r - radius) / across_));
    const std::int64_t to = std::min(row_end - 1, floor_of((r + radius) / across_));
    const std::int64_t left = std::max(-kHalf, floor_of((c - radius) / across_));
    const std::int64_t right = std::min(kHalf - 1, floor_of((c + radius) / across_));
    for (std::int64_t row = from; row <= to; ++row) {
      const std::size_t at = static_cast<std::size_t>(row - rows.first_row);
      const auto begin = keys_.begin() + rows.starts[at], end = keys_.begin() + rows.starts[at + 1];
      const std::uint64_t last = key(field, row, right, kHalf - 1);
      for (auto k = std::lower_bound(begin, end, key(field, row, left, -kHalf));
           k != end && *k <= last; ++k) {
        visit(static_cast<std::uint32_t>(k - keys_.begin()), axis);
      }
    }
  }
}

}  // namespace burnish
