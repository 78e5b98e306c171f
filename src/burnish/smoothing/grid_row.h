#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "burnish/smoothing/equation1.h"

// One row of an image in a pass of Eq. 1. Not part of the library's interface.
namespace burnish {

/// Positions of the pixels of an image, coordinate by coordinate. Rows have room around them for
/// what is read and written beside and beyond them.
class Planes {
 public:
  /// Pixels that are worked on at a time.
  static constexpr std::size_t kLanes = 4;

  void resize(std::size_t width, std::size_t height) {
    stride_ = width + 2 * kLanes;
    for (auto& plane : planes_) plane.assign(stride_ * (height + 2), 0);
  }
  std::size_t stride() const { return stride_; }

  /// Coordinate `axis` of the first pixel of row `y`.
  double* row(std::size_t axis, std::size_t y) { return planes_[axis].data() + first(y); }
  const double* row(std::size_t axis, std::size_t y) const {
    return planes_[axis].data() + first(y);
  }

 private:
  std::size_t first(std::size_t y) const { return (y + 1) * stride_ + kLanes; }

  std::size_t stride_ = 0;
  std::array<std::vector<double>, 3> planes_;
};

/// Moves the vertices of row `y`, of `width` pixels, from `now` to `next` as filter_rings does with
/// `weigh`, to the bit. `masks` says who their neighbours are (see GridRings), 0 for pixels that
/// stay; kLanes more of them follow, 0.
void move_row(const Planes& now, Planes& next, const std::uint8_t* masks, std::size_t y,
              std::size_t width, const Equation1& weigh, double hold);

/// The same without instructions that some machines lack.
void move_one_by_one(const Planes& now, Planes& next, const std::uint8_t* masks, std::size_t y,
                     std::size_t width, const Equation1& weigh, double hold);

}  // namespace burnish
