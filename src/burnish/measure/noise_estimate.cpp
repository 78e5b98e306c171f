#include "burnish/measure/noise_estimate.h"

#include <cmath>

#include "burnish/core/adjacency.h"
#include "burnish/core/edges.h"
#include "burnish/measure/histogram.h"

namespace burnish {

Result<NoiseEstimate> estimate_noise(const TriangleMesh& mesh) {
  if (auto sound = check(mesh); !sound) return sound.error();
  constexpr double kMedianOfNormal = 0.6745;  // of |x| for x standard normal
  const Adjacency rings = one_rings(mesh);
  const std::vector<bool> on_boundary = boundary_vertices(mesh);
  const std::vector<Vec3f> normals = vertex_normals(mesh);
  std::vector<double> offsets;
  for (std::size_t v = 0; v < rings.size(); ++v) {
    const auto ring = rings.row(v);
    if (ring.empty() || on_boundary[v]) continue;
    Vec3d normal(normals[v]), mean;
    const auto count = static_cast<double>(ring.size());
    for (const std::uint32_t w : ring) {
      normal += Vec3d(normals[w]);
      mean += Vec3d(mesh.positions[w]) / count;
    }
    const double height = dot(normalized(normal), Vec3d(mesh.positions[v]) - mean);
    offsets.push_back(std::abs(height) / std::sqrt(1 + 1 / count));
  }
  NoiseEstimate estimate;
  estimate.vertices = offsets.size();
  estimate.sigma = quantile(offsets, 0.5) / kMedianOfNormal;
  const double edge = mean_edge_length(mesh);
  estimate.relative_sigma = edge > 0 ? estimate.sigma / edge : 0;
  return estimate;
}

Facts NoiseEstimate::facts() const {
  return {{"noise_sigma", sigma, "m"},
          {"noise_relative_sigma", relative_sigma, ""},
          {"noise_vertices", static_cast<double>(vertices), ""}};
}

}  // namespace burnish
