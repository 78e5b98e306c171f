#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "burnish/base/result.h"
#include "burnish/io/geometry_file.h"

namespace burnish {

/// What every reader does last: applies the rules of read_geometry for values that are not finite.
/// Errors: bad_file.
Result<GeometryFile> finish_reading(GeometryFile file, const std::string& name);

/// The origin to subtract from coordinates of which `positions` is the float rounding: 0 where
/// float resolves 1e-6 of their extent, else near the middle of them.
Vec3d frame_origin(const std::vector<Vec3f>& positions);

/// Reads a file twice where its coordinates need an origin: `read(origin)` gives a
/// Result<GeometryFile>.
template <class Read>
Result<GeometryFile> read_with_origin(Read read) {
  auto file = read(Vec3d{});
  if (!file) return file;
  const Vec3d origin = frame_origin(file->mesh.positions);
  if (origin == Vec3d{}) return file;
  *file = {};
  return read(origin);
}

/// What the formats with comments keep in them so that a round trip is exact: "burnish frame_origin
/// 500000 4649776 0", "burnish viewpoint 0 0 1.5", "burnish grid 640 480".
struct CommentFacts {
  std::optional<Vec3d> frame_origin, viewpoint;
  std::optional<GridSize> grid;

  void read(std::string_view comment);
};

}  // namespace burnish
