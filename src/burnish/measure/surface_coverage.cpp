#include "burnish/measure/surface_coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "burnish/base/parallel.h"
#include "burnish/measure/surface_samples.h"
#include "burnish/spatial/closest_point.h"

namespace burnish {
namespace {

constexpr std::size_t kGrain = 512;

Result<void> check_params(const CoverageParams& params) {
  const auto refused = [](const char* name, double value, const char* expected) {
    return Error{ErrorCode::invalid_argument,
                 fmt::format("{} = {}, {} expected", name, value, expected),
                 {}};
  };
  if (!(params.spacing >= 0) || !std::isfinite(params.spacing)) {
    return refused("spacing", params.spacing, "a length");
  }
  if (!(params.tolerance > 0) || !std::isfinite(params.tolerance)) {
    return refused("tolerance", params.tolerance, "a positive number of spacings");
  }
  if (!(params.far_away > 0) || !std::isfinite(params.far_away)) {
    return refused("far_away", params.far_away, "a positive number of spacings");
  }
  if (params.samples < 1 || params.samples > 100'000'000) {
    return refused("samples", params.samples, "1 to 100000000");
  }
  return {};
}

std::size_t used_vertices(const TriangleMesh& mesh) {
  std::vector<bool> used(mesh.positions.size());
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) used[v] = true;
  }
  return static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
}

/// The share of the samples of `truth` that have no part of `mesh` within `limit`.
Result<double> missing_share(const TriangleMesh& mesh, const TriangleMesh& truth,
                             std::size_t samples, double limit, const Context& context) {
  const ClosestPoint on_mesh(mesh, context);
  const std::vector<SurfaceSample> points = surface_samples(truth, samples);
  const Vec3d shift = truth.frame.origin - mesh.frame.origin;
  std::size_t missing = 0;
  const bool complete = parallel_reduce(
      context, points.size(), missing,
      [&](IndexRange range) {
        std::size_t count = 0;
        for (std::size_t i = range.begin; i < range.end; ++i) {
          count += on_mesh(points[i].point + shift).distance > limit;
        }
        return count;
      },
      [](std::size_t& total, std::size_t count) { total += count; }, kGrain);
  if (!complete) return cancelled();
  return static_cast<double>(missing) / static_cast<double>(points.size());
}

/// Of each triangle the largest distance of its corners, edge midpoints and centroid from `truth`,
/// in double from the truth's frame; of those that come neither to `enough` nor to the farthest
/// vertex only that of the corners, which is most of the work saved.
class TriangleDistances {
 public:
  TriangleDistances(const TriangleMesh& mesh, const TriangleMesh& truth, const Context& context)
      : mesh_(mesh), on_truth_(truth, context), shift_(mesh.frame.origin - truth.frame.origin) {}

  Result<std::vector<double>> measure(double enough, const Context& context) const {
    std::vector<double> corners(mesh_.positions.size()), distances(mesh_.triangles.size());
    const bool complete = parallel_for(
                              context.part(0, 0.5), corners.size(),
                              [&](IndexRange range) {
                                for (std::size_t v = range.begin; v < range.end; ++v)
                                  corners[v] = distance(place(v));
                              },
                              kGrain) &&
                          parallel_for(
                              context.part(0.5, 0.6), distances.size(),
                              [&](IndexRange range) {
                                for (std::size_t t = range.begin; t < range.end; ++t) {
                                  const auto [a, b, c] = mesh_.triangles[t];
                                  distances[t] = std::max({corners[a], corners[b], corners[c]});
                                }
                              },
                              kGrain);
    if (!complete) return cancelled();
    if (distances.empty()) return distances;
    const double floor = std::min(enough, *std::max_element(distances.begin(), distances.end()));
    if (!parallel_for(
            context.part(0.6, 1), distances.size(),
            [&](IndexRange range) {
              for (std::size_t t = range.begin; t < range.end; ++t) {
                distances[t] = with_inner_points(t, distances[t], floor);
              }
            },
            kGrain)) {
      return cancelled();
    }
    return distances;
  }

 private:
  Vec3d place(std::size_t vertex) const { return Vec3d(mesh_.positions[vertex]) + shift_; }
  double distance(const Vec3d& p) const { return on_truth_(p).distance; }

  double with_inner_points(std::size_t t, double of_corners, double floor) const {
    const auto [i, j, k] = mesh_.triangles[t];
    const Vec3d a = place(i), b = place(j), c = place(k);
    // No point of the triangle is farther from the nearest corner than 1 / sqrt(3) of an edge.
    const double longest =
        std::sqrt(std::max({squared_norm(b - a), squared_norm(c - b), squared_norm(a - c)}));
    if (of_corners + longest / std::numbers::sqrt3 <= floor) return of_corners;
    return std::max({of_corners, distance(0.5 * (a + b)), distance(0.5 * (b + c)),
                     distance(0.5 * (c + a)), distance((1.0 / 3) * (a + b + c))});
  }

  const TriangleMesh& mesh_;
  ClosestPoint on_truth_;
  Vec3d shift_;
};

}  // namespace

Result<SurfaceCoverage> surface_coverage(const TriangleMesh& mesh, const TriangleMesh& truth,
                                         const CoverageParams& params, const Context& context) {
  if (auto valid = check_params(params); !valid) return valid.error();
  if (auto sound = check_surface(mesh, "mesh"); !sound) return sound.error();
  if (auto sound = check_surface(truth, "truth"); !sound) return sound.error();

  SurfaceCoverage result;
  result.true_area = surface_area(truth);
  result.spacing = params.spacing > 0
                       ? params.spacing
                       : std::sqrt(result.true_area / static_cast<double>(used_vertices(mesh)));

  const Result<double> missing =
      missing_share(mesh, truth, static_cast<std::size_t>(params.samples),
                    params.tolerance * result.spacing, context.part(0, 0.3));
  if (!missing) return missing.error();
  result.missing_share = *missing;
  result.missing_area = *missing * result.true_area;

  const double far_away = params.far_away * result.spacing;
  const auto distances =
      TriangleDistances(mesh, truth, context).measure(far_away, context.part(0.3, 1));
  if (!distances) return distances.error();
  const auto farthest = std::max_element(distances->begin(), distances->end());
  result.farthest_triangle_distance = *farthest;
  result.farthest_triangle = static_cast<std::uint32_t>(farthest - distances->begin());
  result.far_triangles =
      static_cast<std::size_t>(std::count_if(distances->begin(), distances->end(), [&](double d) {
        return d > params.far_away * result.spacing;
      }));
  return result;
}

Facts SurfaceCoverage::facts() const {
  return {{"spacing", spacing, "m"},
          {"true_area", true_area, "m2"},
          {"missing_area", missing_area, "m2"},
          {"missing_share", missing_share, ""},
          {"farthest_triangle", static_cast<double>(farthest_triangle), ""},
          {"farthest_triangle_distance", farthest_triangle_distance, "m"},
          {"farthest_in_spacings", farthest_in_spacings(), ""},
          {"far_triangles", static_cast<double>(far_triangles), ""}};
}

}  // namespace burnish
