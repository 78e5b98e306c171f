#include "burnish/points/remove_outliers.h"

#include <algorithm>
#include <cmath>

#include "burnish/base/parallel.h"
#include "burnish/points/missing.h"
#include "burnish/spatial/neighbour_grid.h"

namespace burnish {

const Schema<OutlierParams>& OutlierParams::schema() {
  using P = OutlierParams;
  static const auto schema =
      Schema<P>()
          .integer("neighbours", &P::neighbours, between(1, 1000),
                   "how many neighbours a point must have nearby")
          .real("factor", &P::factor, at_least(1),
                "how many times farther than usual around it the last of them may be");
  return schema;
}

Result<CleaningReport> remove_outliers(PointCloud& cloud, const OutlierParams& params,
                                       const Context& context) {
  if (auto valid = OutlierParams::schema().check(params); !valid) return valid.error();
  if (auto sound = check(cloud); !sound) return sound.error();

  const NeighbourGrid grid(cloud.positions);
  const std::size_t count = cloud.positions.size();
  const std::size_t k = static_cast<std::size_t>(params.neighbours);
  std::vector<std::uint8_t> removed(count);
  if (grid.size() <= k) {
    context.progress(1);
    return take_out(cloud, removed);
  }

  std::vector<std::uint32_t> neighbours(count * k);
  std::vector<float> reach(count);  // to the k-th neighbour
  bool complete = parallel_for(context.part(0, 0.8), count, [&](IndexRange range) {
    std::vector<Neighbour> found;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      if (!is_finite(cloud.positions[i])) continue;
      grid.nearest(cloud.positions[i], k + 1, found);
      std::size_t n = 0;
      for (const Neighbour& neighbour : found) {
        if (neighbour.index != i && n < k) neighbours[i * k + n++] = neighbour.index;
      }
      reach[i] = static_cast<float>(std::sqrt(found.back().squared_distance));
    }
  });
  if (!complete) return cancelled();
  complete = parallel_for(context.part(0.8, 1), count, [&](IndexRange range) {
    std::vector<float> usual(k);
    for (std::size_t i = range.begin; i < range.end; ++i) {
      if (!is_finite(cloud.positions[i])) continue;
      for (std::size_t n = 0; n < k; ++n) usual[n] = reach[neighbours[i * k + n]];
      const auto middle = usual.begin() + static_cast<std::ptrdiff_t>(k / 2);
      std::nth_element(usual.begin(), middle, usual.end());
      removed[i] = reach[i] > params.factor * static_cast<double>(*middle);
    }
  });
  if (!complete) return cancelled();
  return take_out(cloud, removed);
}

}  // namespace burnish
