#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "burnish/core/attributes.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// The image grid of an organized cloud: point (column, row) is number row * width + column.
struct GridSize {
  std::uint32_t width = 0, height = 0;
  friend bool operator==(const GridSize&, const GridSize&) = default;
};

/// Points without connectivity. An organized cloud keeps its image grid and marks pixels without a
/// measurement by NaN in all three coordinates; an unorganized cloud holds finite points only.
struct PointCloud {
  std::vector<Vec3f> positions;   ///< #P, m
  Attributes attributes;          ///< per point
  std::optional<GridSize> grid;   ///< width * height == #P
  std::optional<Vec3d> viewpoint; ///< the camera's position in the world, where there was one camera
  Frame frame;

  friend bool operator==(const PointCloud&, const PointCloud&) = default;
};

/// Whether attributes are #P long, the grid has #P cells, and only pixels of a grid are non-finite.
/// Errors: bad_geometry with the first offender.
Result<void> check(const PointCloud& cloud);

/// The points `kept`, in that order, as an unorganized cloud.
PointCloud select(const PointCloud& cloud, const std::vector<std::uint32_t>& kept);

/// The finite points, in order, as an unorganized cloud.
PointCloud without_missing(const PointCloud& cloud);

}  // namespace burnish
