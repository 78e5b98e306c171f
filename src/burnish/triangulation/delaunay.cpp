#include "burnish/triangulation/delaunay.h"

#include <algorithm>
#include <cmath>

#include "burnish/base/parallel.h"
#include "burnish/triangulation/planar_delaunay.h"
#include "burnish/triangulation/planar_view.h"
#include "burnish/triangulation/plane_order.h"
#include "burnish/triangulation/used_points.h"

namespace burnish {
namespace {

/// The finite points of a cloud as a viewer sees them.
struct Image {
  std::vector<Vec2d> points;
  std::vector<std::uint32_t> source;  ///< their numbers in the cloud
};

Image image_of(const PointCloud& cloud, const PlanarView& view) {
  Image image;
  image.points.reserve(cloud.positions.size());
  image.source.reserve(cloud.positions.size());
  for (std::uint32_t i = 0; i < cloud.positions.size(); ++i) {
    if (!is_finite(cloud.positions[i])) continue;
    image.points.push_back(view(cloud.positions[i]));
    image.source.push_back(i);
  }
  return image;
}

/// Leaves of points on one place the nearest to the viewer, of equally near ones the first. Returns
/// how many went.
std::size_t keep_nearest(std::vector<Keyed>& order, const Image& image, const PointCloud& cloud,
                         const PlanarView& view) {
  const auto nearness = [&](const Keyed& item) {
    return view.nearness(cloud.positions[image.source[item.index]]);
  };
  std::size_t kept = 0;
  for (const Keyed& item : order) {
    if (kept == 0 || image.points[item.index] != image.points[order[kept - 1].index]) {
      order[kept++] = item;
    } else if (nearness(item) > nearness(order[kept - 1])) {
      order[kept - 1] = item;
    }
  }
  const std::size_t gone = order.size() - kept;
  order.resize(kept);
  return gone;
}

double squared_distance(const Vec2d& a, const Vec2d& b) {
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

/// Which triangles stay.
class Judge {
 public:
  Judge(const PointCloud& cloud, const Image& image, const PlanarView& view,
        const DelaunayParams& params)
      : cloud_(cloud),
        image_(image),
        view_(view),
        squared_edge_(params.max_edge > 0 ? params.max_edge * params.max_edge : HUGE_VAL),
        least_cosine_(params.max_angle < std::numbers::pi / 2 ? std::cos(params.max_angle) : 0) {}

  bool keeps_all() const {
    return view_.step() == 0 && squared_edge_ == HUGE_VAL && least_cosine_ == 0;
  }
  bool keeps(const Triangle& t) const { return !too_thin(t) && !too_long_or_steep(t); }

 private:
  /// Three points on a line are at most sqrt(2) steps off it when their coordinates are rounded.
  bool too_thin(const Triangle& t) const {
    if (view_.step() == 0) return false;
    const Vec2d &a = image_.points[t[0]], &b = image_.points[t[1]], &c = image_.points[t[2]];
    const double area = (a.x - c.x) * (b.y - c.y) - (a.y - c.y) * (b.x - c.x);
    const double longest =
        std::max({squared_distance(a, b), squared_distance(b, c), squared_distance(c, a)});
    return area * area <= 2 * view_.step() * view_.step() * longest;
  }

  bool too_long_or_steep(const Triangle& t) const {
    const Vec3d a = position(t[0]), b = position(t[1]), c = position(t[2]);
    if (std::max({squared_norm(b - a), squared_norm(c - b), squared_norm(a - c)}) > squared_edge_)
      return true;
    if (least_cosine_ == 0) return false;
    const Vec3d normal = cross(b - a, c - a), to_viewer = view_.to_viewer((a + b + c) / 3);
    return dot(normal, to_viewer) < least_cosine_ * norm(normal) * norm(to_viewer);
  }

  Vec3d position(std::uint32_t point) const {
    return Vec3d(cloud_.positions[image_.source[point]]);
  }

  const PointCloud& cloud_;
  const Image& image_;
  const PlanarView& view_;
  double squared_edge_, least_cosine_;
};

}  // namespace

const Schema<DelaunayParams>& DelaunayParams::schema() {
  using P = DelaunayParams;
  static const auto schema =
      Schema<P>()
          .choice("projection", &P::projection,
                  {{"plane", Projection::plane},
                   {"x", Projection::x},
                   {"y", Projection::y},
                   {"z", Projection::z},
                   {"view", Projection::view}},
                  "along the normal of a plane fitted, an axis, or the rays from the viewpoint")
          .real("max_edge", &P::max_edge, at_least(0),
                "triangles with a longer edge are dropped; 0: none", Quantity::length)
          .real("max_angle", &P::max_angle, between(0, std::numbers::pi / 2),
                "triangles seen under a larger angle to their normal are dropped; 90deg: none",
                Quantity::angle);
  return schema;
}

Result<Triangulation> triangulate_delaunay(const PointCloud& cloud, const DelaunayParams& params,
                                           const Context& context) {
  if (auto valid = DelaunayParams::schema().check(params); !valid) return valid.error();
  if (auto sound = check(cloud); !sound) return sound.error();
  if (context.cancelled()) return cancelled();
  context.stage("projecting points");
  const Result<PlanarView> view = PlanarView::of(cloud, params.projection);
  if (!view) return view.error();
  const Image image = image_of(cloud, *view);
  std::vector<Keyed> order = order_in_plane(image.points);
  const std::size_t duplicates = keep_nearest(order, image, cloud, *view);
  context.progress(0.2);

  context.stage("triangulating");
  std::vector<Triangle> triangles;
  if (!planar_delaunay(image.points, order, context.part(0.2, 0.9), triangles)) return cancelled();
  const Judge judge(cloud, image, *view, params);
  if (!judge.keeps_all())
    std::erase_if(triangles, [&](const Triangle& t) { return !judge.keeps(t); });
  for (Triangle& t : triangles) t = {image.source[t[0]], image.source[t[1]], image.source[t[2]]};

  Triangulation result = mesh_of_used_points(cloud, std::move(triangles));
  result.report.duplicate_points = duplicates;
  if (context.cancelled()) return cancelled();
  context.progress(1);
  return result;
}

}  // namespace burnish
