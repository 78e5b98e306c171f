#include "burnish/measure/triangle_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "burnish/core/adjacency.h"
#include "burnish/core/edges.h"
#include "burnish/measure/angle_between.h"

namespace burnish {
namespace {

double length_between(const TriangleMesh& mesh, std::uint32_t a, std::uint32_t b) {
  return norm(Vec3d(mesh.positions[a]) - Vec3d(mesh.positions[b]));
}

struct Spread {
  double mean = 0;
  double relative = 0;  ///< standard deviation / mean; 0 where the mean is 0
};

Spread spread(std::span<const double> values) {
  if (values.empty()) return {};
  const auto count = static_cast<double>(values.size());
  double sum = 0, squares = 0;
  for (const double v : values) sum += v;
  const double mean = sum / count;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return {mean, mean > 0 ? std::sqrt(squares / count) / mean : 0};
}

void measure_angles(const TriangleMesh& mesh, TriangleQuality& quality) {
  std::vector<double> all, least_of_triangles;
  all.reserve(mesh.triangles.size() * 3);
  double ratios = 0;
  quality.radius_ratio_min = mesh.triangles.empty() ? 0 : 1;
  for (const Triangle& t : mesh.triangles) {
    const std::array<Vec3d, 3> p{Vec3d(mesh.positions[t[0]]), Vec3d(mesh.positions[t[1]]),
                                 Vec3d(mesh.positions[t[2]])};
    double least = std::numbers::pi;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d a = p[(i + 1) % 3] - p[i], b = p[(i + 2) % 3] - p[i];
      if (squared_norm(a) == 0 || squared_norm(b) == 0) continue;
      all.push_back(angle_between(a, b));
      least = std::min(least, all.back());
    }
    least_of_triangles.push_back(least < std::numbers::pi ? least : 0);
    const double ratio = radius_ratio(p[0], p[1], p[2]);
    ratios += ratio;
    quality.radius_ratio_min = std::min(quality.radius_ratio_min, ratio);
  }
  quality.angles = histogram(all, 0, std::numbers::pi, 36);
  if (mesh.triangles.empty()) return;
  quality.radius_ratio_mean = ratios / static_cast<double>(mesh.triangles.size());
  quality.smallest_angle_mean = spread(least_of_triangles).mean;
  quality.smallest_angle = *std::min_element(least_of_triangles.begin(), least_of_triangles.end());
  quality.smallest_angle_p01 = quantile(least_of_triangles, 0.01);
  quality.largest_angle = all.empty() ? 0 : *std::max_element(all.begin(), all.end());
}

void measure_edges(const TriangleMesh& mesh, TriangleQuality& quality) {
  std::vector<double> lengths;
  for (const Edge& edge : edges(mesh)) {
    lengths.push_back(length_between(mesh, edge.vertices[0], edge.vertices[1]));
  }
  const Spread of_edges = spread(lengths);
  quality.edge_length_mean = of_edges.mean;
  quality.edge_spread = of_edges.relative;
  quality.edge_lengths = histogram(lengths, 0, of_edges.mean > 0 ? 3 * of_edges.mean : 1, 60);
  if (lengths.empty()) return;
  const auto [least, greatest] = std::minmax_element(lengths.begin(), lengths.end());
  quality.edge_length_min = *least;
  quality.edge_length_max = *greatest;
}

void measure_rings(const TriangleMesh& mesh, TriangleQuality& quality) {
  const Adjacency rings = one_rings(mesh);
  std::vector<double> distances;
  double sum = 0;
  std::size_t count = 0;
  for (std::uint32_t v = 0; v < rings.size(); ++v) {
    if (rings.row(v).empty()) continue;
    distances.clear();
    for (const std::uint32_t w : rings.row(v)) distances.push_back(length_between(mesh, v, w));
    sum += spread(distances).relative;
    ++count;
  }
  quality.neighbour_distance_spread = count > 0 ? sum / static_cast<double>(count) : 0;
}

}  // namespace

double radius_ratio(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const double x = norm(b - c), y = norm(c - a), z = norm(a - b);
  const double denominator = x * y * z * (x + y + z);
  // squared_norm of the cross product is 4 A^2.
  return denominator > 0 ? 4 * squared_norm(cross(b - a, c - a)) / denominator : 0;
}

Result<TriangleQuality> triangle_quality(const TriangleMesh& mesh, const Context& context) {
  if (auto sound = check(mesh); !sound) return sound.error();
  TriangleQuality quality;
  quality.triangles = mesh.triangles.size();
  const std::array<void (*)(const TriangleMesh&, TriangleQuality&), 3> steps{
      measure_angles, measure_edges, measure_rings};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (context.cancelled()) return cancelled();
    steps[i](mesh, quality);
    context.progress(static_cast<double>(i + 1) / steps.size());
  }
  return quality;
}

Facts TriangleQuality::facts() const {
  return {{"triangles", static_cast<double>(triangles), ""},
          {"smallest_angle", smallest_angle, "rad"},
          {"smallest_angle_p01", smallest_angle_p01, "rad"},
          {"smallest_angle_mean", smallest_angle_mean, "rad"},
          {"largest_angle", largest_angle, "rad"},
          {"radius_ratio_min", radius_ratio_min, ""},
          {"radius_ratio_mean", radius_ratio_mean, ""},
          {"edge_length_mean", edge_length_mean, "m"},
          {"edge_length_min", edge_length_min, "m"},
          {"edge_length_max", edge_length_max, "m"},
          {"edge_spread", edge_spread, ""},
          {"neighbour_distance_spread", neighbour_distance_spread, ""}};
}

}  // namespace burnish
