#include "burnish/smoothing/grid_passes.h"

#include "burnish/smoothing/equation1.h"

namespace burnish {

void GridPasses::prepare(const GridRings& rings) {
  if (size_ == rings.size) return;
  size_ = rings.size;
  const auto neighbours = grid_neighbours(size_.width);
  for (std::size_t mask = 0; mask < rings_.size(); ++mask) {
    Ring& ring = rings_[mask] = {};
    for (std::size_t k = 0; k < 8; ++k) {
      if (mask >> k & 1) ring.neighbours[ring.count++] = neighbours[k];
    }
  }
  for (auto& positions : positions_) positions.resize(std::size_t{size_.width} * size_.height);
  first_.resize(std::size_t{size_.height} + 1);
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
  prepare(rings);
  const std::size_t width = size_.width, height = size_.height;
  const auto passes = static_cast<std::size_t>(params.iterations);
  std::size_t next_vertex = 0;
  for (std::size_t row = 0; row < height; ++row) {
    first_[row] = next_vertex;
    while (next_vertex < pixels.size() && pixels[next_vertex] < (row + 1) * width) ++next_vertex;
  }
  first_[height] = next_vertex;

  const Equation1 weigh(positions);
  const double hold = params.damping;
  const auto fill_row = [&](std::size_t row) {
    for (std::size_t v = first_[row]; v < first_[row + 1]; ++v) {
      positions_[0][pixels[v]] = Vec3d(positions[v]);
    }
  };
  const auto pass_over_row = [&](std::size_t pass, std::size_t row) {
    const Vec3d* const now = positions_[pass % 2].data();
    Vec3d* const next = positions_[1 - pass % 2].data();
    for (std::size_t v = first_[row]; v < first_[row + 1]; ++v) {
      const std::uint32_t pixel = pixels[v];
      const Ring& ring = rings_[rings.inner[pixel]];
      if (ring.count == 0) {
        next[pixel] = now[pixel];
        continue;
      }
      std::array<std::uint32_t, 8> ids;
      for (std::size_t k = 0; k < 8; ++k) {
        ids[k] = pixel + static_cast<std::uint32_t>(ring.neighbours[k]);
      }
      const WeightedSum all = weigh.sum(now, pixel, {ids.data(), ring.count});
      next[pixel] = (1 - hold) * (all.sum / all.weight) + hold * now[pixel];
    }
  };
  for (std::size_t row = 0; row < height + passes; ++row) {
    if (context.cancelled()) return cancelled();
    if (row < height) fill_row(row);
    for (std::size_t pass = 0; pass < passes && pass < row; ++pass) {
      const std::size_t behind = row - pass - 1;
      if (behind < height) pass_over_row(pass, behind);
    }
  }
  const std::vector<Vec3d>& result = positions_[passes % 2];
  for (std::size_t v = 0; v < pixels.size(); ++v) positions[v] = Vec3f(result[pixels[v]]);
  context.progress(1);
  return {};
}

}  // namespace burnish
