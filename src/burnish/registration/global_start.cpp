#include "burnish/registration/global_start.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "burnish/registration/cloud_steps.h"
#include "burnish/registration/consensus.h"
#include "burnish/registration/evidence.h"
#include "burnish/registration/fpfh.h"

namespace burnish {
namespace {

constexpr double kCellsInRadius = 16;
constexpr double kFeatureCells = 5;      // radius of the descriptors
constexpr double kTolerance = 2;         // cells by which a pose may miss
constexpr std::size_t kHypotheses = 60;  // whose overlap is looked at
constexpr double kNearCells = 1.5;       // within which a cell lies on the other surface
constexpr double kLikeNormal = 0.7;
constexpr double kWorthwhile = 0.6;  // of the best start's overlap

double radius_of(const std::vector<Vec3f>& positions) {
  Vec3d sum;
  double squares = 0;
  for (const Vec3f& p : positions) {
    sum += Vec3d(p);
    squares += squared_norm(Vec3d(p));
  }
  const double n = std::max<double>(static_cast<double>(positions.size()), 1);
  return std::sqrt(std::max(0.0, squares / n - squared_norm(sum / n)));
}

/// The share of the source's points that T brings onto the target.
double overlap(const OrientedPoints& source, const OrientedPoints& target,
               const NeighbourGrid& grid, const RigidTransform& T, double reach,
               std::vector<Neighbour>& near) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < source.size(); ++i) {
    grid.nearest(Vec3f(T(Vec3d(source.positions[i]))), 1, near);
    if (near.empty() || near.front().squared_distance > reach * reach) continue;
    const Vec3d n(target.normals[near.front().index]);
    count += dot(n, T.rotate(Vec3d(source.normals[i]))) > kLikeNormal ? 1 : 0;
  }
  return static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(source.size(), 1));
}

/// Poses to start from, the likeliest first; none where cancelled.
std::optional<std::vector<Hypothesis>> find_starts(const OrientedPoints& source,
                                                   const OrientedPoints& target, double cell,
                                                   const GlobalStartParams& params,
                                                   const Context& context) {
  const std::vector<Fpfh> a = fpfh(source, kFeatureCells * cell, context.part(0, 0.2));
  const std::vector<Fpfh> b = fpfh(target, kFeatureCells * cell, context.part(0.2, 0.4));
  if (context.cancelled()) return {};
  const auto matches = mutual_matches(a, b, context.part(0.4, 0.7));
  if (!matches) return {};
  auto found =
      consensus(source, target, *matches, kTolerance * cell, static_cast<std::size_t>(params.draws),
                kHypotheses, context.part(0.7, 0.9));
  if (!found) return {};
  const NeighbourGrid grid(target.positions);
  std::vector<Neighbour> near;
  for (Hypothesis& h : *found) {
    if (context.cancelled()) return {};
    h.score = overlap(source, target, grid, h.T_target_source, kNearCells * cell, near);
  }
  std::stable_sort(found->begin(), found->end(),
                   [](const Hypothesis& x, const Hypothesis& y) { return x.score > y.score; });
  if (found->size() > static_cast<std::size_t>(params.starts)) {
    found->resize(static_cast<std::size_t>(params.starts));
  }
  return found;
}

/// Whether a is to be preferred to b.
bool better(const PairRegistration& a, const PairRegistration& b) {
  if (a.accepted() != b.accepted()) return a.accepted();
  return a.overlap * (1 - a.contradiction) > b.overlap * (1 - b.contradiction);
}

using Refine = std::function<Result<PairRegistration>(const RigidTransform&, const Context&)>;

/// The best of what refining the starts gives; refining the identity where there is none. Starts
/// that bring much less of the source onto the target than the first are left alone. Where two
/// poses are acceptable that are unlike each other by `tolerance`, neither can be relied on.
Result<PairRegistration> refine_all(std::vector<Hypothesis> starts, double tolerance,
                                    const Refine& refine, const Context& context) {
  if (starts.empty()) starts.push_back({});
  std::optional<PairRegistration> best;
  bool ambiguous = false;
  const double share = 1 / static_cast<double>(starts.size());
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const Hypothesis& start = starts[i];
    if (start.score < kWorthwhile * starts.front().score) break;
    const double begin = share * static_cast<double>(i);
    Result<PairRegistration> pair =
        refine(start.T_target_source, context.part(begin, begin + share));
    if (!pair) return pair;
    if (best && best->accepted() && pair->accepted()) {
      const Vec3d middle = best->T_target_source.inverse()(best->centre);
      ambiguous =
          ambiguous || !alike(best->T_target_source, pair->T_target_source, middle, tolerance);
    }
    if (!best || better(*pair, *best)) best = *std::move(pair);
  }
  context.progress(1);
  if (ambiguous) {
    best->refusals.push_back(Refusal::ambiguous);
    best->reason = "another pose explains the data as well";
  }
  return *std::move(best);
}

OrientedPoints points_of(const SurfaceView& view) {
  OrientedPoints points;
  for (const SurfacePixel& pixel : view.pixels) {
    if (!(squared_norm(pixel.normal) > 0)) continue;
    points.positions.push_back(pixel.position);
    points.normals.push_back(pixel.normal);
  }
  return points;
}

double cell_of(const GlobalStartParams& params, double radius) {
  return params.cell > 0 ? params.cell : std::max(radius / kCellsInRadius, 1e-9);
}

}  // namespace

const Schema<GlobalStartParams>& GlobalStartParams::schema() {
  using P = GlobalStartParams;
  static const auto schema =
      Schema<P>()
          .real("cell", &P::cell, at_least(0),
                "side of the cells to which clouds are thinned; 0: by the target's radius",
                Quantity::length)
          .integer("draws", &P::draws, between(1, 100000000),
                   "triples of correspondences that are tried")
          .integer("starts", &P::starts, between(1, 1000), "poses that are refined");
  return schema;
}

Result<PairRegistration> register_clouds_globally(const PointCloud& source,
                                                  const PointCloud& target,
                                                  const GlobalStartParams& start,
                                                  const CloudsParams& params,
                                                  const Context& context) {
  if (auto valid = GlobalStartParams::schema().check(start); !valid) return valid.error();
  if (auto valid = CloudsParams::schema().check(params); !valid) return valid.error();
  auto surfaces = cloud_surfaces(source, target, params.distortion, context.part(0, 0.3));
  if (!surfaces) return surfaces.error();
  const CloudTarget &from = surfaces->first, &to = surfaces->second;
  const double cell = cell_of(start, to.surface.radius);
  const auto starts = find_starts(thinned(from.surface.positions, from.surface.normals, cell),
                                  thinned(to.surface.positions, to.surface.normals, cell), cell,
                                  start, context.part(0.3, 0.6));
  if (!starts) return cancelled();
  CloudsParams refining = params;
  refining.reach = 2 * kTolerance * cell;
  auto pair = refine_all(
      *starts, kTolerance * cell,
      [&](const RigidTransform& T, const Context& part) {
        return register_surfaces(from, to, T, refining, part);
      },
      context.part(0.6, 1));
  if (!pair) return pair;
  return in_world(*std::move(pair), from.surface.origin, to.surface.origin);
}

Result<PairRegistration> register_views_globally(const SurfaceView& source,
                                                 const SurfaceView& target,
                                                 const GlobalStartParams& start,
                                                 const ProjectiveParams& params,
                                                 const Context& context) {
  if (auto valid = GlobalStartParams::schema().check(start); !valid) return valid.error();
  for (const SurfaceView* view : {&source, &target}) {
    if (auto sound = check(*view); !sound) return sound.error();
  }
  const OrientedPoints from = points_of(source), to = points_of(target);
  const double cell = cell_of(start, radius_of(to.positions));
  const auto starts =
      find_starts(thinned(from.positions, from.normals, cell),
                  thinned(to.positions, to.normals, cell), cell, start, context.part(0, 0.6));
  if (!starts) return cancelled();
  ProjectiveParams refining = params;
  refining.reach = 2 * kTolerance * cell;
  return refine_all(
      *starts, kTolerance * cell,
      [&](const RigidTransform& T, const Context& part) {
        return register_projective(source, target, T, refining, part);
      },
      context.part(0.6, 1));
}

}  // namespace burnish
