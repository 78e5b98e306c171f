#include "burnish/measure/denoising_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
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

void measure_normals(const TriangleMesh& mesh, const TriangleMesh& truth, DenoisingError& error) {
  double sum = 0;
  for (std::size_t t = 0; t < truth.triangles.size(); ++t) {
    const Vec3d right = area_vector(truth, t), found = area_vector(mesh, t);
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

bool measure_distances(const TriangleMesh& mesh, const TriangleMesh& truth, DenoisingError& error,
                       const Context& context) {
  const ClosestPoint on_truth(truth, context);
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
  error.vertex_error_in_edges = error.vertex_error / mean_edge_length(truth);
  error.vertex_error_permille = 1000 * error.vertex_error / diagonal(truth);
  return true;
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
  measure_normals(mesh, truth, error);
  const Result<AreaAndVolume> size = area_and_volume(mesh), true_size = area_and_volume(truth);
  if (!size) return size.error();
  if (!true_size) return true_size.error();
  if (size->volume && true_size->volume && *true_size->volume != 0) {
    error.volume_change = *size->volume / *true_size->volume - 1;
  }
  if (!measure_distances(mesh, truth, error, context)) return cancelled();
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
