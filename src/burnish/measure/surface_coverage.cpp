#include "burnish/measure/surface_coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

/// Of each triangle the largest distance of its corners, edge midpoints and centroid from `truth`.
Result<std::vector<double>> triangle_distances(const TriangleMesh& mesh, const TriangleMesh& truth,
                                               const Context& context) {
  const ClosestPoint on_truth(truth, context);
  const Vec3d shift = mesh.frame.origin - truth.frame.origin;
  std::vector<double> of_vertices(mesh.positions.size()), of_triangles(mesh.triangles.size());
  const auto measure_vertices = [&](IndexRange range) {
    for (std::size_t v = range.begin; v < range.end; ++v) {
      of_vertices[v] = on_truth(Vec3d(mesh.positions[v]) + shift).distance;
    }
  };
  const auto measure_triangles = [&](IndexRange range) {
    for (std::size_t t = range.begin; t < range.end; ++t) {
      Vec3d corners[3];
      double most = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        corners[i] = Vec3d(mesh.positions[mesh.triangles[t][i]]) + shift;
        most = std::max(most, of_vertices[mesh.triangles[t][i]]);
      }
      const Vec3d inner[] = {0.5 * (corners[0] + corners[1]), 0.5 * (corners[1] + corners[2]),
                             0.5 * (corners[2] + corners[0]),
                             (1.0 / 3) * (corners[0] + corners[1] + corners[2])};
      for (const Vec3d& p : inner) most = std::max(most, on_truth(p).distance);
      of_triangles[t] = most;
    }
  };
  if (!parallel_for(context.part(0, 0.2), of_vertices.size(), measure_vertices, kGrain) ||
      !parallel_for(context.part(0.2, 1), of_triangles.size(), measure_triangles, kGrain)) {
    return cancelled();
  }
  return of_triangles;
}

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

  const auto distances = triangle_distances(mesh, truth, context.part(0.3, 1));
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
