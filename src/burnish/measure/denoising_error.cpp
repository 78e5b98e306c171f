#include "burnish/measure/denoising_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "burnish/base/parallel.h"
#include "burnish/core/edges.h"
#include "burnish/measure/angle_between.h"
#include "burnish/measure/area_and_volume.h"
#include "burnish/measure/surface_samples.h"
#include "burnish/spatial/closest_point.h"

namespace burnish {
namespace {

constexpr double kRightAngle = std::numbers::pi / 2;

Result<void> check_correspondence(const TriangleMesh& mesh, const TriangleMesh& truth) {
  const auto differ = [](std::string message) {
    return Error{ErrorCode::bad_geometry, std::move(message), "mesh"};
  };
  if (mesh.positions.size() != truth.positions.size()) {
    return differ(fmt::format("{} vertices, those of the truth were expected: {}",
                              mesh.positions.size(), truth.positions.size()));
  }
  if (mesh.triangles.size() != truth.triangles.size()) {
    return differ(fmt::format("{} triangles, those of the truth were expected: {}",
                              mesh.triangles.size(), truth.triangles.size()));
  }
  const auto [mine, theirs] =
      std::mismatch(mesh.triangles.begin(), mesh.triangles.end(), truth.triangles.begin());
  if (mine == mesh.triangles.end()) return {};
  return differ(fmt::format("triangle {} is {} {} {}, in the truth {} {} {}",
                            mine - mesh.triangles.begin(), (*mine)[0], (*mine)[1], (*mine)[2],
                            (*theirs)[0], (*theirs)[1], (*theirs)[2]));
}

/// To triangle t of the mesh corresponds corresponding[t] of the truth.
void measure_normals(const TriangleMesh& mesh, const TriangleMesh& truth,
                     const std::vector<std::uint32_t>& corresponding, DenoisingError& error) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3d right = area_vector(truth, corresponding[t]), found = area_vector(mesh, t);
    if (squared_norm(right) == 0) continue;
    const bool collapsed = squared_norm(found) == 0;
    const double angle = collapsed ? kRightAngle : angle_between(found, right);
    sum += angle;
    ++error.triangles;
    error.collapsed_triangles += collapsed;
    error.flipped_triangles += angle > kRightAngle;
  }
  error.normal_error = sum / static_cast<double>(error.triangles);
}

/// Twice the area around each vertex.
std::vector<double> areas_around_vertices(const TriangleMesh& mesh) {
  std::vector<double> areas(mesh.positions.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) areas[v] += norm(area_vector(mesh, t));
  }
  return areas;
}

double diagonal(const TriangleMesh& mesh) {
  Vec3f low = mesh.positions.front(), high = low;
  for (const Vec3f& p : mesh.positions) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  return norm(Vec3d(high) - Vec3d(low));
}

/// `edge` is the length in which the distances are told besides.
bool measure_distances(const TriangleMesh& mesh, const TriangleMesh& truth,
                       const ClosestPoint& on_truth, double edge, DenoisingError& error,
                       const Context& context) {
  const Vec3d shift = mesh.frame.origin - truth.frame.origin;
  const std::vector<double> weights = areas_around_vertices(mesh);
  std::vector<double> distances(weights.size());
  const bool complete = parallel_for(
      context, distances.size(),
      [&](IndexRange range) {
        for (std::size_t v = range.begin; v < range.end; ++v) {
          if (weights[v] > 0) distances[v] = on_truth(Vec3d(mesh.positions[v]) + shift).distance;
        }
      },
      512);
  if (!complete) return false;
  double squares = 0, weight = 0;
  for (std::size_t v = 0; v < distances.size(); ++v) {
    squares += weights[v] * distances[v] * distances[v];
    weight += weights[v];
  }
  error.vertex_error = std::sqrt(squares / weight);
  error.vertex_error_in_edges = error.vertex_error / edge;
  error.vertex_error_permille = 1000 * error.vertex_error / diagonal(truth);
  return true;
}

Result<void> measure_volumes(const TriangleMesh& mesh, const TriangleMesh& truth,
                             DenoisingError& error) {
  const Result<AreaAndVolume> size = area_and_volume(mesh), true_size = area_and_volume(truth);
  if (!size) return size.error();
  if (!true_size) return true_size.error();
  if (size->volume && true_size->volume && *true_size->volume != 0) {
    error.volume_change = *size->volume / *true_size->volume - 1;
  }
  return {};
}

/// The triangle of the truth that is nearest to the centroid of each one of the mesh.
bool find_nearest(const TriangleMesh& mesh, const TriangleMesh& truth, const ClosestPoint& on_truth,
                  std::vector<std::uint32_t>& nearest, const Context& context) {
  const Vec3d shift = mesh.frame.origin - truth.frame.origin;
  nearest.resize(mesh.triangles.size());
  return parallel_for(
      context, nearest.size(),
      [&](IndexRange range) {
        for (std::size_t t = range.begin; t < range.end; ++t) {
          Vec3d sum;
          for (const std::uint32_t v : mesh.triangles[t]) sum += Vec3d(mesh.positions[v]);
          nearest[t] = on_truth(sum / 3.0 + shift).triangle;
        }
      },
      512);
}

}  // namespace

bool correspond(const TriangleMesh& a, const TriangleMesh& b) {
  return a.positions.size() == b.positions.size() && a.triangles == b.triangles;
}

Result<DenoisingError> compare_denoised(const TriangleMesh& mesh, const TriangleMesh& truth,
                                        const Context& context) {
  if (auto sound = check_surface(mesh, "mesh"); !sound) return sound.error();
  if (auto sound = check_surface(truth, "truth"); !sound) return sound.error();
  if (auto alike = check_correspondence(mesh, truth); !alike) return alike.error();
  DenoisingError error;
  if (auto known = measure_volumes(mesh, truth, error); !known) return known.error();
  std::vector<std::uint32_t> same(mesh.triangles.size());
  std::iota(same.begin(), same.end(), 0);
  measure_normals(mesh, truth, same, error);
  const ClosestPoint on_truth(truth, context);
  if (!measure_distances(mesh, truth, on_truth, mean_edge_length(truth), error, context)) {
    return cancelled();
  }
  return error;
}

Result<DenoisingError> compare_to_nearest(const TriangleMesh& mesh, const TriangleMesh& truth,
                                          const Context& context) {
  if (auto sound = check_surface(mesh, "mesh"); !sound) return sound.error();
  if (auto sound = check_surface(truth, "truth"); !sound) return sound.error();
  DenoisingError error;
  if (auto known = measure_volumes(mesh, truth, error); !known) return known.error();
  const ClosestPoint on_truth(truth, context);
  std::vector<std::uint32_t> nearest;
  if (!find_nearest(mesh, truth, on_truth, nearest, context.part(0, 0.6)) ||
      !measure_distances(mesh, truth, on_truth, mean_edge_length(mesh), error,
                         context.part(0.6, 1))) {
    return cancelled();
  }
  measure_normals(mesh, truth, nearest, error);
  return error;
}

Facts DenoisingError::facts() const {
  Facts facts{{"normal_error", normal_error, "rad"},
              {"flipped_triangles", static_cast<double>(flipped_triangles), ""},
              {"collapsed_triangles", static_cast<double>(collapsed_triangles), ""},
              {"vertex_error", vertex_error, "m"},
              {"vertex_error_in_edges", vertex_error_in_edges, ""},
              {"vertex_error_permille", vertex_error_permille, ""}};
  if (volume_change) facts.push_back({"volume_change", *volume_change, ""});
  return facts;
}

}  // namespace burnish
