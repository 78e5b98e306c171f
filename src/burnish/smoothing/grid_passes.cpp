#include "burnish/smoothing/grid_passes.h"

#include <algorithm>

namespace burnish {

void GridPasses::prepare(const GridSize& size, std::span<const std::uint32_t> pixels) {
  if (size_ != size) {
    size_ = size;
    for (Planes& planes : planes_) planes.resize(size.width, size.height);
    first_.resize(std::size_t{size.height} + 1);
    masks_.assign(std::size_t{size.width} + Planes::kLanes, 0);
  }
  std::size_t next = 0;
  for (std::size_t row = 0; row < size.height; ++row) {
    first_[row] = next;
    while (next < pixels.size() && pixels[next] < (row + 1) * size.width) ++next;
  }
  first_[size.height] = next;
}

Result<void> GridPasses::smooth(const GridRings& rings, std::span<const std::uint32_t> pixels,
                                const NearestFarthestParams& params, const Context& context,
                                std::span<Vec3f> positions) {
  if (auto valid = NearestFarthestParams::schema().check(params); !valid) return valid;
  if (params.boundary != BoundaryRule::fixed || params.order != UpdateOrder::jacobi) {
    return Error{ErrorCode::invalid_argument,
                 "on an image grid boundary = fixed and order = jacobi are expected",
                 {}};
  }
  prepare(rings.size, pixels);
  const std::size_t width = size_.width, height = size_.height;
  const auto passes = static_cast<std::size_t>(params.iterations);
  const Equation1 weigh(positions);
  const auto put = [&](std::size_t row) {
    double *x = planes_[0].row(0, row), *y = planes_[0].row(1, row), *z = planes_[0].row(2, row);
    for (std::size_t v = first_[row]; v < first_[row + 1]; ++v) {
      const std::size_t column = pixels[v] - row * width;
      x[column] = double{positions[v].x};
      y[column] = double{positions[v].y};
      z[column] = double{positions[v].z};
    }
  };
  const auto take = [&](std::size_t row) {
    const Planes& result = planes_[passes % 2];
    const double *x = result.row(0, row), *y = result.row(1, row), *z = result.row(2, row);
    for (std::size_t v = first_[row]; v < first_[row + 1]; ++v) {
      const std::size_t column = pixels[v] - row * width;
      positions[v] = Vec3f(Vec3d{x[column], y[column], z[column]});
    }
  };
  for (std::size_t row = 0; row < height + passes; ++row) {
    if (context.cancelled()) return cancelled();
    if (row < height) put(row);
    for (std::size_t pass = 0; pass < passes && pass < row; ++pass) {
      const std::size_t behind = row - pass - 1;
      if (behind >= height) continue;
      std::copy_n(rings.inner.data() + behind * width, width, masks_.data());
      move_row(planes_[pass % 2], planes_[1 - pass % 2], masks_.data(), behind, width, weigh,
               params.damping);
    }
  }
  for (std::size_t row = 0; row < height; ++row) take(row);
  context.progress(1);
  return {};
}

}  // namespace burnish
