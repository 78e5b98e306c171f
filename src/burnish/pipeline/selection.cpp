#include "burnish/pipeline/selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "burnish/base/quantity.h"
#include "burnish/io/geometry_file.h"
#include "burnish/pipeline/region.h"
#include "burnish/spatial/closest_point.h"

namespace burnish {
namespace {

using PointTest = std::function<bool(const Vec3d&)>;

constexpr std::string_view kNear = "near:";

Box bounds_of(const TriangleMesh& mesh, double margin) {
  Box box{Vec3d(mesh.positions.front()), Vec3d(mesh.positions.front())};
  for (const Vec3f& p : mesh.positions) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min<double>(box.low[axis], p[axis]);
      box.high[axis] = std::max<double>(box.high[axis], p[axis]);
    }
  }
  const Vec3d wide{margin, margin, margin};
  return {box.low - wide, box.high + wide};
}

Result<PointTest> near_surface(std::string_view text, const Context& context) {
  const std::size_t comma = text.rfind(',');
  if (comma == std::string_view::npos || comma == 0) {
    return Error{ErrorCode::invalid_argument,
                 fmt::format("'{}{}' is not near:MESH,distance", kNear, text),
                 {}};
  }
  const Result<double> distance = parse_quantity(text.substr(comma + 1), Quantity::length);
  if (!distance) return distance.error();
  if (!(*distance >= 0)) {
    return Error{ErrorCode::invalid_argument,
                 fmt::format("'{}{}': the distance must not be negative", kNear, text),
                 {}};
  }
  const Result<TriangleMesh> mesh = read_mesh(text.substr(0, comma), context.part(0, 0.7));
  if (!mesh) return mesh.error();
  const auto surface = std::make_shared<const ClosestPoint>(*mesh, context.part(0.7, 1));
  if (context.cancelled()) return cancelled();
  // Most points are far away: the box spares them the way through the tree.
  return PointTest([surface, box = Region(bounds_of(*mesh, *distance)), origin = mesh->frame.origin,
                    limit = *distance](const Vec3d& point) {
    const Vec3d local = point - origin;
    return contains(box, local) && (*surface)(local).distance <= limit;
  });
}

}  // namespace

Result<PointTest> read_selection(std::string_view text, const Context& context) {
  if (text.starts_with(kNear)) return near_surface(text.substr(kNear.size()), context);
  const Result<Region> region = parse_region(text);
  if (region) return PointTest([region = *region](const Vec3d& p) { return contains(region, p); });
  Error error = region.error();
  const bool known = text.starts_with("box:") || text.starts_with("sphere:");
  if (!known) error.message += " nor near:MESH,distance";
  return error;
}

}  // namespace burnish
