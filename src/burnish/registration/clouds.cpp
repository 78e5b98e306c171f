#include "burnish/registration/clouds.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "burnish/base/parallel.h"
#include "burnish/registration/cloud_steps.h"
#include "burnish/registration/evidence.h"
#include "burnish/registration/normal_equations.h"
#include "burnish/registration/robust.h"

namespace burnish {
namespace {

constexpr std::size_t kGrain = 256;
constexpr double kThinning = 3;         // from level to level
constexpr double kContradicts = 5;      // deviations
constexpr double kBeside = 2;           // spacings that a counterpart may be off along the surface
constexpr double kFlatness = 1e-3;      // of a point's neighbourhood: variance across over along
constexpr double kFarOff = 8;           // spacings beyond which it is no counterpart at all
constexpr double kWindowPoints = 30;    // that share the noise of their normals
constexpr std::size_t kJudged = 20000;  // points that a verdict looks at

double square(double x) {
  return x * x;
}

/// A point of the source and the nearest of the target.
struct Match {
  std::uint32_t source, target;
  Vec3d x, q, n, m;  ///< the points, and the normals of target and source, target coordinates
  double agreement;  ///< n . m, positive where they may be alike

  Vec3d offset() const { return x - q; }
};

class Matcher {
 public:
  Matcher(const CloudTarget& source, const CloudTarget& target, const RigidTransform& T)
      : source_(source.surface),
        target_(target.surface),
        grid_(target.grid),
        T_(T),
        oriented_(source.surface.oriented && target.surface.oriented) {}

  Match find(std::uint32_t i, std::vector<Neighbour>& scratch) const {
    const Vec3d x = T_(Vec3d(source_.positions[i]));
    grid_.nearest(Vec3f(x), 1, scratch);
    const std::uint32_t t = scratch.front().index;
    const Vec3d n(target_.normals[t]);
    Vec3d m = T_.rotate(Vec3d(source_.normals[i]));
    if (!oriented_ && dot(n, m) < 0) m = -m;
    return {i, t, x, Vec3d(target_.positions[t]), n, m, dot(n, m)};
  }

  double noise_variance(const Match& match) const {
    return square(source_.sigma[match.source]) + square(target_.sigma[match.target]);
  }
  double bias_variance(const Match& match) const {
    return square(source_.bias[match.source]) + square(target_.bias[match.target]);
  }
  double spacing(const Match& match) const {
    return std::max(source_.spacing[match.source], target_.spacing[match.target]);
  }

  /// Adds a match to a pass, its error by its plane or by both.
  void add_plane(const Match& match, double tolerance, NormalEquations& sums) const {
    const double r = dot(match.n, match.offset());
    const double variance = noise_variance(match) + bias_variance(match) + square(tolerance);
    const double trust = tukey_weight(r * r / variance);
    if (!(trust > 0)) return;
    sums.add(moment_row(match.x, match.n), r, trust / variance);
    sums.weight += trust;
  }
  void add_generalized(const Match& match, double tolerance, NormalEquations& sums) const {
    const Vec3d d = match.offset();
    const Eigen::Matrix3d covariance =
        surface_covariance(source_, match.source, match.m, tolerance) +
        surface_covariance(target_, match.target, match.n, tolerance);
    const Eigen::Matrix3d root =
        covariance.llt().matrixL().solve(Eigen::Matrix3d::Identity().eval());
    const Eigen::Vector3d r = root * Eigen::Vector3d(d.x, d.y, d.z);
    const double trust = tukey_weight(r.squaredNorm());
    if (!(trust > 0)) return;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const Vec3d row{root(k, 0), root(k, 1), root(k, 2)};
      sums.add(moment_row(match.x, row), r[k], trust);
    }
    sums.weight += trust;
  }

 private:
  static Eigen::Matrix3d surface_covariance(const CloudSurface& surface, std::uint32_t i,
                                            const Vec3d& normal, double tolerance) {
    const double across =
        square(surface.sigma[i]) + square(surface.bias[i]) + square(tolerance) / 2;
    const double along = across / kFlatness;
    const Eigen::Vector3d n(normal.x, normal.y, normal.z);
    return along * Eigen::Matrix3d::Identity() + (across - along) * n * n.transpose();
  }

  const CloudSurface &source_, &target_;
  const NeighbourGrid& grid_;
  const RigidTransform& T_;
  bool oriented_;
};

std::optional<NormalEquations> gather(const Matcher& matcher, std::span<const std::uint32_t> points,
                                      CloudError error, double tolerance, const Context& context) {
  NormalEquations total;
  const bool complete = parallel_reduce(
      context, points.size(), total,
      [&](IndexRange range) {
        NormalEquations sums;
        std::vector<Neighbour> scratch;
        for (std::size_t i = range.begin; i < range.end; ++i) {
          const Match match = matcher.find(points[i], scratch);
          if (match.agreement < kLikeNormals) continue;
          if (error == CloudError::generalized) {
            matcher.add_generalized(match, tolerance, sums);
          } else {
            matcher.add_plane(match, tolerance, sums);
          }
        }
        return sums;
      },
      [](NormalEquations& sum, const NormalEquations& part) { sum += part; }, kGrain);
  if (!complete) return {};
  return total;
}

/// `share`: of the points of the one cloud so many are looked at; `bias_points`: that share a
/// systematic error.
void look(const Matcher& matcher, const Match& match, double share, double noise_points,
          double bias_points, Evidence& sum) {
  ++sum.points;
  const Vec3d d = match.offset();
  const double r = dot(match.n, d), spacing = matcher.spacing(match);
  const double noise = matcher.noise_variance(match), bias = matcher.bias_variance(match);
  const double off = std::sqrt(r * r / (noise + bias));
  const double beside = norm(d - match.n * r);
  const bool near = off <= kInlier || std::abs(r) <= kFarOff * spacing;
  if (beside > kBeside * spacing || !near || match.agreement < kLikeNormals) return;
  ++sum.compared;
  if (off > kContradicts) ++sum.contradicted;
  if (off > kInlier) return;
  sum.add_match(match.x, match.n, match.m,
                1 / (share * (noise * noise_points + bias * bias_points)), off);
  sum.patches += 1 / (share * kWindowPoints);
}

std::optional<Evidence> gather_evidence(const CloudTarget& source, const CloudTarget& target,
                                        const RigidTransform& T, const Context& context) {
  const Matcher matcher(source, target, T);
  const std::vector<std::uint32_t> points = sample(source.surface.size(), kJudged, 2);
  const double total = static_cast<double>(source.surface.size());
  const double share = static_cast<double>(points.size()) / total;
  Evidence evidence;
  const bool complete = parallel_reduce(
      context, points.size(), evidence,
      [&](IndexRange range) {
        Evidence sum;
        std::vector<Neighbour> scratch;
        for (std::size_t i = range.begin; i < range.end; ++i) {
          look(matcher, matcher.find(points[i], scratch), share, source.surface.noise_points,
               std::max(1.0, total * kBiasPatch), sum);
        }
        return sum;
      },
      [](Evidence& sum, const Evidence& part) { sum += part; }, kGrain);
  if (!complete) return {};
  return evidence;
}

}  // namespace

const Schema<CloudsParams>& CloudsParams::schema() {
  using P = CloudsParams;
  static const auto schema =
      Schema<P>()
          .choice("error", &P::error,
                  {{"point_to_plane", CloudError::point_to_plane},
                   {"generalized", CloudError::generalized}},
                  "what makes two points counterparts of one surface")
          .real("reach", &P::reach, at_least(0),
                "how far off the guess may put the surfaces; 0: a sixth of the target's radius",
                Quantity::length)
          .integer("samples", &P::samples, between(100, 10000000),
                   "points of the source on the finest level")
          .integer("levels", &P::levels, between(1, 6), "each coarser one takes a third of them")
          .integer("max_iterations", &P::max_iterations, between(1, 1000), "on each level")
          .real("distortion", &P::distortion, at_least(0),
                "systematic error of one over the depth where there is a viewpoint, 1/m")
          .group(&P::acceptance, AcceptanceParams::schema());
  return schema;
}

Result<std::pair<CloudTarget, CloudTarget>> cloud_surfaces(const PointCloud& source,
                                                           const PointCloud& target,
                                                           double distortion,
                                                           const Context& context) {
  Result<CloudSurface> s = cloud_surface(source, distortion, context.part(0, 0.5));
  if (!s) return Error{s.error().code, s.error().message, "source"};
  Result<CloudSurface> t = cloud_surface(target, distortion, context.part(0.5, 1));
  if (!t) return Error{t.error().code, t.error().message, "target"};
  return std::pair(CloudTarget(*std::move(s)), CloudTarget(*std::move(t)));
}

Result<PairRegistration> register_surfaces(const CloudTarget& source, const CloudTarget& target,
                                           const RigidTransform& guess, const CloudsParams& params,
                                           const Context& context) {
  PairRegistration pair;
  RigidTransform& T = pair.T_target_source = guess;
  double tolerance = (params.reach > 0 ? params.reach : target.surface.radius / 6) / kTukey;
  const double share = 0.9 / (params.levels * params.max_iterations);
  for (int level = params.levels - 1; level >= 0; --level) {
    const bool finest = level == 0;
    if (finest) tolerance = 0;
    const auto points =
        sample(source.surface.size(),
               static_cast<std::size_t>(params.samples / std::pow(kThinning, level)), 1);
    pair.converged = false;
    const double begin = 0.9 * (params.levels - 1 - level) / params.levels;
    for (int i = 0; i < params.max_iterations && !pair.converged; ++i, ++pair.iterations) {
      const auto sums = gather(Matcher(source, target, T), points, params.error, tolerance,
                               context.part(begin + share * i, begin + share * (i + 1)));
      if (!sums) return cancelled();
      const auto step = solve(*sums, finest ? kFineDamping : kCoarseDamping);
      if (!step) break;
      T = moved(T, step->twist);
      pair.converged = is_still(*step, *sums, finest, source.surface.noise_points);
    }
    tolerance /= kGraduation;
  }
  const RigidTransform back = T.inverse();
  const auto forward = gather_evidence(source, target, T, context.part(0.9, 0.95));
  if (!forward) return cancelled();
  const auto backward = gather_evidence(target, source, back, context.part(0.95, 1));
  if (!backward) return cancelled();
  judge(*forward, *backward, params.acceptance, pair);
  return pair;
}

PairRegistration in_world(PairRegistration pair, const Vec3d& source_origin,
                          const Vec3d& target_origin) {
  RigidTransform& T = pair.T_target_source;
  T.translation += target_origin - T.rotate(source_origin);
  pair.centre += target_origin;
  move_twists(target_origin, pair);
  return pair;
}

Result<PairRegistration> register_clouds(const PointCloud& source, const PointCloud& target,
                                         const RigidTransform& T_target_source_guess,
                                         const CloudsParams& params, const Context& context) {
  if (auto valid = CloudsParams::schema().check(params); !valid) return valid.error();
  if (auto sound = check_pose(T_target_source_guess); !sound) return sound.error();
  auto surfaces = cloud_surfaces(source, target, params.distortion, context.part(0, 0.4));
  if (!surfaces) return surfaces.error();
  const CloudTarget &from = surfaces->first, &to = surfaces->second;
  const Vec3d source_origin = from.surface.origin, target_origin = to.surface.origin;
  RigidTransform T = T_target_source_guess;
  T.translation += T.rotate(source_origin) - target_origin;
  Result<PairRegistration> pair = register_surfaces(from, to, T, params, context.part(0.4, 1));
  if (!pair) return pair;
  return in_world(*std::move(pair), source_origin, target_origin);
}

}  // namespace burnish
