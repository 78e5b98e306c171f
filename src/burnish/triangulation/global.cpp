#include "burnish/triangulation/global.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "burnish/core/gather.h"
#include "burnish/points/surface_normals.h"
#include "burnish/triangulation/front.h"
#include "burnish/triangulation/local_fans.h"
#include "burnish/triangulation/manifold_surface.h"
#include "burnish/triangulation/point_order.h"
#include "burnish/triangulation/small_holes.h"
#include "burnish/triangulation/used_points.h"
#include "burnish/triangulation/vote.h"

namespace burnish {
namespace {

/// A shred has at most so many vertices.
constexpr std::size_t kShred = 12;

/// So many triangles or points are dealt with, in some milliseconds, between two looks at whether
/// the run was cancelled.
constexpr std::size_t kBetweenLooks = 8192;

/// A hole that measured triangles surround may be wider than what a triangle bridges unasked.
constexpr double kHoleReach = 4.0 / 3;

/// Takes of the candidates, in their order, what is joined to the surface and fits. Returns false
/// where cancelled.
bool join_fitting(std::vector<Candidate> candidates, const Context& context,
                  ManifoldSurface& surface) {
  std::sort(candidates.begin(), candidates.end(), sooner);
  // What is not joined to the surface yet may be once others are.
  for (bool grown = true; grown;) {
    grown = false;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (i % kBetweenLooks == 0 && context.cancelled()) return false;
      const Triangle& t = candidates[i].triangle;
      if (!surface.touches(t)) {
        candidates[kept++] = candidates[i];
      } else if (!surface.overlaps(t)) {
        grown = surface.add_if_manifold(t) || grown;
      }
    }
    candidates.resize(kept);
  }
  return true;
}

/// Three fans that agree on triangles never contradict each other: in a vertex's fan every
/// neighbour has one successor. The others are taken where they fit. Returns false where cancelled.
bool insert_by_vote(const std::vector<Candidate>& candidates, const Context& context,
                    ManifoldSurface& surface) {
  std::vector<Candidate> doubtful;
  for (const Candidate& candidate : candidates) {
    if (candidate.votes == 3) {
      surface.add(candidate.triangle);
    } else {
      doubtful.push_back(candidate);
    }
  }
  return !context.cancelled() && join_fitting(std::move(doubtful), context, surface);
}

/// The ends of an edge do not know of a triangle that the third corner's fan alone holds: such ones
/// are taken once nothing grows any more. Returns false where cancelled.
bool insert_by_growth(const std::vector<Candidate>& candidates, const Fans& fans,
                      const TriangleJudge& judge, const Context& context,
                      ManifoldSurface& surface) {
  return grow_front(candidates, fans, judge, context, surface) &&
         join_fitting(candidates, context, surface);
}

/// Estimates the normals of `positions`, which are points of `cloud`.
bool orient(const PointCloud& cloud, std::span<const Vec3f> positions, const NeighbourGrid& grid,
            const NeighbourLists& neighbours, const Context& context, std::vector<Vec3f>& normals) {
  std::optional<Vec3d> viewpoint;
  if (cloud.viewpoint) viewpoint = *cloud.viewpoint - cloud.frame.origin;
  std::size_t components = 0;
  return normals_of_surface(positions, grid, neighbours, viewpoint, context, normals, components);
}

/// Leaves every vertex one fan, its largest. Returns false where cancelled.
bool separate_pinched_vertices(ManifoldSurface& surface, const Context& context) {
  std::vector<std::vector<std::uint32_t>> paths;
  for (bool changed = true; changed;) {
    if (context.cancelled()) return false;
    changed = false;
    for (const ManifoldSurface::Corner& corner : surface.corners()) {
      surface.paths(corner.vertex, paths);
      for (std::size_t i = 1; i < paths.size(); ++i) {
        for (const std::uint32_t triangle : paths[i]) surface.remove(triangle);
        changed = true;
      }
    }
  }
  return true;
}

/// Removes small pieces where the fan of one of their vertices reaches a larger one, which they did
/// not fit into. Returns false where cancelled.
bool remove_shreds(const Fans& fans, ManifoldSurface& surface, const Context& context) {
  std::vector<std::uint32_t> shreds;
  for (const ManifoldSurface::Corner& corner : surface.corners()) {
    if (context.cancelled()) return false;
    if (surface.is_larger(corner.vertex, kShred)) continue;
    const auto rim = fans.rim(corner.vertex);
    const bool beside = std::any_of(rim.begin(), rim.end(), [&](std::uint32_t q) {
      return q != Fans::kGap && surface.is_larger(q, kShred);
    });
    if (beside) shreds.push_back(corner.vertex);
  }
  for (const std::uint32_t vertex : shreds) surface.remove_piece(vertex);
  return true;
}

/// The surface as a mesh of points of `cloud`, which `order` names.
Triangulation to_mesh(const ManifoldSurface& surface, const PointCloud& cloud,
                      const std::vector<std::uint32_t>& order) {
  std::vector<Triangle> triangles;
  std::vector<Origin> origin;
  surface.triangles(triangles, origin);
  for (Triangle& t : triangles) t = {order[t[0]], order[t[1]], order[t[2]]};
  Triangulation result = mesh_of_used_points(cloud, std::move(triangles));
  result.report.duplicate_points = result.report.points - order.size();
  result.report.invented_triangles =
      static_cast<std::size_t>(std::count(origin.begin(), origin.end(), Origin::invented));
  result.mesh.triangle_attributes.origin = std::move(origin);
  return result;
}

}  // namespace

const Schema<GlobalParams>& GlobalParams::schema() {
  using P = GlobalParams;
  static const auto schema =
      Schema<P>()
          .choice("agreement", &P::agreement,
                  {{"vote", Agreement::vote}, {"front", Agreement::front}},
                  "triangles come in the order of the fans that agree on them, or grow from seeds")
          .integer("neighbours", &P::neighbours, between(3, 1000),
                   "neighbours that a fan begins with; doubled while they do not suffice")
          .integer("most_neighbours", &P::most_neighbours, between(3, 10000),
                   "neighbours that a fan looks at at most")
          .real("sheet_angle", &P::sheet_angle, between(0, std::numbers::pi),
                "neighbours whose normals are further apart are on another sheet", Quantity::angle)
          .real("max_gap", &P::max_gap, more_than(0),
                "farthest that a point of a triangle is from its nearest corner, relative to the "
                "median edge of a corner's fan")
          .integer("hole_edges", &P::hole_edges, between(0, 100),
                   "boundary loops of at most so many edges are closed");
  return schema;
}

Result<Triangulation> triangulate_global(const PointCloud& cloud, const GlobalParams& params,
                                         const Context& context) {
  if (auto valid = GlobalParams::schema().check(params); !valid) return valid.error();
  if (auto sound = check(cloud); !sound) return sound.error();

  context.stage("ordering points");
  const std::vector<std::uint32_t> order = order_along_curve(cloud.positions);
  const std::vector<Vec3f> positions = gather(cloud.positions, order);
  context.stage("finding neighbours");
  const NeighbourGrid grid(positions);
  NeighbourLists neighbours;
  if (!grid.nearest_of_all(static_cast<std::size_t>(params.neighbours) + 1, context.part(0, 0.2),
                           neighbours)) {
    return cancelled();
  }
  context.stage("estimating normals");
  std::vector<Vec3f> normals = gather(cloud.attributes.normals, order);
  if (normals.empty() &&
      !orient(cloud, positions, grid, neighbours, context.part(0.2, 0.4), normals)) {
    return cancelled();
  }

  context.stage("building fans");
  const FanRule rule{.most_neighbours = static_cast<std::size_t>(
                         std::max(params.most_neighbours, params.neighbours)),
                     .cos_sheet_angle = std::cos(params.sheet_angle)};
  Fans fans;
  const TriangleJudge judge(positions, normals, fans, params.max_gap);
  std::vector<Candidate> candidates;
  if (!build_fans(positions, normals, grid, neighbours, rule, context.part(0.4, 0.7), fans) ||
      !count_votes(fans, judge, context.part(0.7, 0.8), candidates)) {
    return cancelled();
  }

  if (context.cancelled()) return cancelled();
  context.stage("inserting triangles");
  ManifoldSurface surface(positions, normals);
  const bool inserted = params.agreement == Agreement::vote
                            ? insert_by_vote(candidates, context, surface)
                            : insert_by_growth(candidates, fans, judge, context, surface);
  if (!inserted) return cancelled();
  context.progress(0.85);
  context.stage("closing holes");
  const HoleRule hole_rule{static_cast<std::size_t>(params.hole_edges),
                           kHoleReach * params.max_gap};
  const auto close_holes = [&] {
    return close_small_holes(surface, positions, normals, fans, hole_rule, context);
  };
  if (!close_holes() || !separate_pinched_vertices(surface, context) ||
      !remove_shreds(fans, surface, context) || !close_holes()) {
    return cancelled();
  }

  if (context.cancelled()) return cancelled();
  Triangulation result = to_mesh(surface, cloud, order);
  context.progress(1);
  return result;
}

}  // namespace burnish
