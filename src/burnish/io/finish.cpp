#include "burnish/io/finish.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "burnish/core/gather.h"
#include "burnish/io/cursor.h"

namespace burnish {
namespace {

/// Pixels of which one coordinate is not finite are missing.
void mark_missing(std::vector<Vec3f>& positions) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (Vec3f& p : positions) {
    if (!is_finite(p)) p = {kNan, kNan, kNan};
  }
}

/// Leaves out the vertices that are not finite; an error where a triangle uses one.
Result<void> leave_out_non_finite(GeometryFile& file, const std::string& name) {
  TriangleMesh& mesh = file.mesh;
  std::vector<std::uint32_t> kept;
  const std::size_t count = mesh.positions.size();
  std::vector<std::uint32_t> renamed(count);
  for (std::size_t v = 0; v < count; ++v) {
    renamed[v] = static_cast<std::uint32_t>(kept.size());
    if (is_finite(mesh.positions[v])) kept.push_back(static_cast<std::uint32_t>(v));
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::uint32_t& v : mesh.triangles[t]) {
      if (!is_finite(mesh.positions[v])) {
        return Error{ErrorCode::bad_file,
                     fmt::format("vertex {} (counted from 0) of triangle {} is not finite", v, t),
                     name};
      }
      v = renamed[v];
    }
  }
  std::vector<std::uint32_t>& owner = mesh.triangle_attributes.owner;
  if (std::any_of(owner.begin(), owner.end(),
                  [&](std::uint32_t v) { return !is_finite(mesh.positions[v]); })) {
    owner.clear();
    file.notes.push_back("the owners of triangles are left out: not all of them are finite");
  }
  for (std::uint32_t& v : owner) v = renamed[v];
  mesh.positions = gather(mesh.positions, kept);
  mesh.attributes = gather(mesh.attributes, kept);
  file.notes.push_back(fmt::format("{} of {} {} are not finite and are left out",
                                   count - kept.size(), count,
                                   mesh.triangles.empty() ? "points" : "vertices"));
  return {};
}

}  // namespace

Result<GeometryFile> finish_reading(GeometryFile file, const std::string& name) {
  std::vector<Vec3f>& positions = file.mesh.positions;
  const std::size_t count = positions.size();
  if (file.grid && (!file.mesh.triangles.empty() ||
                    std::size_t{file.grid->width} * file.grid->height != count)) {
    file.grid.reset();
  }
  if (file.grid) {
    mark_missing(positions);
  } else if (!std::all_of(positions.begin(), positions.end(),
                          [](const Vec3f& p) { return is_finite(p); })) {
    if (auto ok = leave_out_non_finite(file, name); !ok) return ok.error();
  }
  std::size_t unknown = 0;
  for (Vec3f& normal : file.mesh.attributes.normals) {
    if (is_finite(normal)) continue;
    normal = {};
    ++unknown;
  }
  if (unknown > 0 && !file.grid) {
    file.notes.push_back(fmt::format("{} normals are not finite and count as unknown", unknown));
  }
  return file;
}

Vec3d frame_origin(const std::vector<Vec3f>& positions) {
  Vec3d low{INFINITY, INFINITY, INFINITY};
  Vec3d high = -low;
  for (const Vec3f& p : positions) {
    if (!is_finite(p)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], double{p[axis]});
      high[axis] = std::max(high[axis], double{p[axis]});
    }
  }
  if (!is_finite(low)) return {};
  double extent = 0;
  double largest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    extent = std::max(extent, high[axis] - low[axis]);
    largest = std::max({largest, std::abs(low[axis]), std::abs(high[axis])});
  }
  const double resolution = largest * 0x1p-24;  // half the distance of neighbouring floats
  if (resolution <= 1e-6 * extent) return {};
  // A multiple of a power of two has few digits, so that origin + position is exact in double.
  const double step = std::exp2(std::floor(std::log2(std::max(extent, resolution))));
  Vec3d origin;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    origin[axis] = std::round((low[axis] + high[axis]) / 2 / step) * step + 0.0;
  }
  return origin;
}

void CommentFacts::read(std::string_view comment) {
  Cursor cursor(comment, {});
  if (cursor.word() != "burnish") return;
  const std::string_view what = cursor.word();
  const auto vector = [&](std::optional<Vec3d>& out) {
    Vec3d v;
    if (cursor.number(v.x) && cursor.number(v.y) && cursor.number(v.z) && is_finite(v)) out = v;
  };
  if (what == "frame_origin") vector(frame_origin);
  if (what == "viewpoint") vector(viewpoint);
  GridSize size;
  if (what == "grid" && cursor.number(size.width) && cursor.number(size.height)) grid = size;
}

}  // namespace burnish
