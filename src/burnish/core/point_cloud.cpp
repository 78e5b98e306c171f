#include "burnish/core/point_cloud.h"

#include <fmt/format.h>

#include "burnish/core/gather.h"

namespace burnish {

Result<void> check(const PointCloud& cloud) {
  const std::size_t count = cloud.positions.size();
  if (cloud.grid) {
    if (std::size_t{cloud.grid->width} * cloud.grid->height != count) {
      return Error{ErrorCode::bad_geometry,
                   fmt::format("the grid is {} x {} for {} points", cloud.grid->width,
                               cloud.grid->height, count), {}};
    }
  } else {
    for (std::size_t i = 0; i < count; ++i) {
      if (!is_finite(cloud.positions[i])) {
        return Error{ErrorCode::bad_geometry, fmt::format("point {} is not finite", i), {}};
      }
    }
  }
  return check_lengths(cloud.attributes, count);
}

PointCloud select(const PointCloud& cloud, const std::vector<std::uint32_t>& kept) {
  return {gather(cloud.positions, kept), gather(cloud.attributes, kept), std::nullopt,
          cloud.viewpoint, cloud.frame};
}

PointCloud without_missing(const PointCloud& cloud) {
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < cloud.positions.size(); ++i) {
    if (is_finite(cloud.positions[i])) kept.push_back(i);
  }
  return select(cloud, kept);
}

}  // namespace burnish
