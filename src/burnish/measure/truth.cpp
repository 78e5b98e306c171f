#include "burnish/measure/truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "burnish/base/parallel.h"
#include "burnish/measure/angle_between.h"
#include "burnish/measure/histogram.h"
#include "burnish/measure/surface_samples.h"
#include "burnish/spatial/closest_point.h"

namespace burnish {
namespace {

Distances summary(std::vector<double> distances) {
  Distances result;
  result.count = distances.size();
  if (distances.empty()) return result;
  double sum = 0, squares = 0;
  for (const double d : distances) {
    sum += d;
    squares += d * d;
    result.max = std::max(result.max, d);
  }
  const auto count = static_cast<double>(distances.size());
  result.mean = sum / count;
  result.rms = std::sqrt(squares / count);
  result.p95 = quantile(distances, 0.95);
  return result;
}

/// found(i) is told what is closest to point(i).
template <class PointOf, class Tell>
bool find_all(const Context& context, std::size_t count, const ClosestPoint& surface, PointOf point,
              Tell found) {
  return parallel_for(
      context, count,
      [&](IndexRange range) {
        for (std::size_t i = range.begin; i < range.end; ++i) found(i, surface(point(i)));
      },
      512);
}

}  // namespace

Result<TruthComparison> compare_to_truth(const TriangleMesh& mesh, const TriangleMesh& truth,
                                         const TruthParams& params, const Context& context) {
  if (params.samples < 1 || params.samples > 100'000'000) {
    return Error{ErrorCode::invalid_argument,
                 fmt::format("samples = {}, 1 to 100000000 expected", params.samples),
                 {}};
  }
  if (auto sound = check_surface(mesh, "mesh"); !sound) return sound.error();
  if (auto sound = check_surface(truth, "truth"); !sound) return sound.error();
  const ClosestPoint on_mesh(mesh, context), on_truth(truth, context);
  if (context.cancelled()) return cancelled();
  const Vec3d shift =
      mesh.frame.origin - truth.frame.origin;  // from the mesh's frame to the truth's
  const auto count = static_cast<std::size_t>(params.samples);

  TruthComparison result;
  const std::vector<SurfaceSample> samples = surface_samples(mesh, count);
  std::vector<double> distances(count), angles(count);
  bool complete = find_all(
      context.part(0, 0.4), count, on_truth,
      [&](std::size_t i) { return samples[i].point + shift; },
      [&](std::size_t i, const ClosestPoint::Found& found) {
        distances[i] = found.distance;
        angles[i] = angle_between(area_vector(mesh, samples[i].triangle),
                                  area_vector(truth, found.triangle));
      });
  if (!complete) return cancelled();
  result.to_truth = summary(distances);
  result.mean_normal_error = summary(angles).mean;

  std::vector<double> of_vertices(mesh.positions.size());
  complete = find_all(
      context.part(0.4, 0.6), of_vertices.size(), on_truth,
      [&](std::size_t v) { return Vec3d(mesh.positions[v]) + shift; },
      [&](std::size_t v, const ClosestPoint::Found& found) { of_vertices[v] = found.distance; });
  if (!complete) return cancelled();
  result.deviation.assign(of_vertices.begin(), of_vertices.end());
  result.vertices = summary(std::move(of_vertices));

  const std::vector<SurfaceSample> true_samples = surface_samples(truth, count);
  complete = find_all(
      context.part(0.6, 1), count, on_mesh,
      [&](std::size_t i) { return true_samples[i].point - shift; },
      [&](std::size_t i, const ClosestPoint::Found& found) { distances[i] = found.distance; });
  if (!complete) return cancelled();
  result.from_truth = summary(std::move(distances));
  return result;
}

Result<Distances> compare_to_truth(const PointCloud& cloud, const TriangleMesh& truth,
                                   const Context& context) {
  if (auto sound = check(cloud); !sound) return sound.error();
  if (auto sound = check_surface(truth, "truth"); !sound) return sound.error();
  const PointCloud points = without_missing(cloud);
  const ClosestPoint on_truth(truth, context);
  if (context.cancelled()) return cancelled();
  const Vec3d shift = cloud.frame.origin - truth.frame.origin;
  std::vector<double> distances(points.positions.size());
  const bool complete = find_all(
      context, distances.size(), on_truth,
      [&](std::size_t i) { return Vec3d(points.positions[i]) + shift; },
      [&](std::size_t i, const ClosestPoint::Found& found) { distances[i] = found.distance; });
  if (!complete) return cancelled();
  return summary(std::move(distances));
}

double TruthComparison::hausdorff() const {
  return std::max({to_truth.max, vertices.max, from_truth.max});
}

Facts Distances::facts() const {
  return {{"count", static_cast<double>(count), ""},
          {"rms", rms, "m"},
          {"mean", mean, "m"},
          {"p95", p95, "m"},
          {"max", max, "m"}};
}

Facts TruthComparison::facts() const {
  Facts all;
  const auto add = [&all](const std::string& prefix, const Distances& distances) {
    for (Fact fact : distances.facts()) {
      fact.key = prefix + fact.key;
      all.push_back(std::move(fact));
    }
  };
  add("to_truth_", to_truth);
  add("vertices_", vertices);
  add("from_truth_", from_truth);
  all.push_back({"hausdorff", hausdorff(), "m"});
  all.push_back({"mean_normal_error", mean_normal_error, "rad"});
  return all;
}

}  // namespace burnish
