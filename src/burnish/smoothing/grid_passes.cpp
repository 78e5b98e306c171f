#include "burnish/smoothing/grid_passes.h"

#include "burnish/smoothing/equation1.h"

namespace burnish {

namespace {

/// One pass over vertices that have `count` neighbours each.
template <std::size_t count>
void move(const Equation1& weigh, double hold, const std::array<std::int32_t, 8>* neighbours,
          const std::uint8_t* masks, std::span<const std::uint32_t> pixels, const Vec3d* now,
          Vec3d* next) {
  for (const std::uint32_t pixel : pixels) {
    if constexpr (count == 0) {
      next[pixel] = now[pixel];
    } else {
      const auto& around = neighbours[masks[pixel]];
      std::array<std::uint32_t, count> ring;
      for (std::size_t k = 0; k < count; ++k) {
        ring[k] = pixel + static_cast<std::uint32_t>(around[k]);
      }
      const WeightedSum all = weigh.sum(now, pixel, ring);
      next[pixel] = (1 - hold) * (all.sum / all.weight) + hold * now[pixel];
    }
  }
}

constexpr auto kMoves = [] {
  return std::array{move<0>, move<1>, move<2>, move<3>, move<4>,
                    move<5>, move<6>, move<7>, move<8>};
}();

}  // namespace

void GridPasses::prepare(const GridSize& size) {
  if (size_ == size) return;
  size_ = size;
  const auto neighbours = grid_neighbours(size_.width);
  for (std::size_t mask = 0; mask < neighbours_.size(); ++mask) {
    counts_[mask] = 0;
    for (std::size_t k = 0; k < 8; ++k) {
      if (mask >> k & 1) neighbours_[mask][counts_[mask]++] = neighbours[k];
    }
  }
  const std::size_t pixels = std::size_t{size_.width} * size_.height;
  for (auto& positions : positions_) positions.resize(pixels);
  sorted_.resize(pixels);
  first_.resize(std::size_t{size_.height} + 1);
  groups_.resize(size_.height);
}

void GridPasses::sort_rows(const GridRings& rings, std::span<const std::uint32_t> pixels) {
  std::size_t next = 0;
  for (std::size_t row = 0; row < size_.height; ++row) {
    const std::size_t begin = first_[row] = next;
    std::array<std::uint32_t, 10> place{};
    for (; next < pixels.size() && pixels[next] < (row + 1) * size_.width; ++next) {
      ++place[counts_[rings.inner[pixels[next]]] + 1u];
    }
    place[0] = static_cast<std::uint32_t>(begin);
    for (std::size_t count = 1; count < place.size(); ++count) place[count] += place[count - 1];
    groups_[row] = place;
    for (std::size_t v = begin; v < next; ++v) {
      sorted_[place[counts_[rings.inner[pixels[v]]]]++] = pixels[v];
    }
  }
  first_[size_.height] = next;
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
  prepare(rings.size);
  sort_rows(rings, pixels);
  const std::size_t height = size_.height;
  const auto passes = static_cast<std::size_t>(params.iterations);
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
    const auto& group = groups_[row];
    for (std::size_t count = 0; count < kMoves.size(); ++count) {
      const std::span<const std::uint32_t> alike(sorted_.data() + group[count],
                                                 group[count + 1] - group[count]);
      if (!alike.empty()) {
        kMoves[count](weigh, hold, neighbours_.data(), rings.inner.data(), alike, now, next);
      }
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
