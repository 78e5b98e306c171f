#include "burnish/smoothing/face_geometry.h"

#include "burnish/base/parallel.h"
#include "burnish/core/edges.h"

namespace burnish {

double mean_centroid_distance(const TriangleMesh& mesh, const Adjacency& edge_neighbours) {
  const auto centroid = [&](std::size_t f) {
    const auto [a, b, c] = mesh.triangles[f];
    return (Vec3d(mesh.positions[a]) + Vec3d(mesh.positions[b]) + Vec3d(mesh.positions[c])) / 3.;
  };
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t f = 0; f < edge_neighbours.size(); ++f) {
    for (const std::uint32_t g : edge_neighbours.row(f)) {
      if (g < f) continue;
      sum += norm(centroid(g) - centroid(f));
      ++count;
    }
  }
  if (sum > 0) return sum / static_cast<double>(count);
  const double edge = mean_edge_length(mesh);
  return edge > 0 ? edge : 1;
}

FaceSurface face_surface(const TriangleMesh& mesh, double unit) {
  Vec3d mean;
  for (const Vec3f& p : mesh.positions) mean += Vec3d(p);
  if (!mesh.positions.empty()) mean = mean / static_cast<double>(mesh.positions.size());
  FaceSurface surface{.positions = {}, .unit = unit};
  surface.positions.reserve(mesh.positions.size());
  for (const Vec3f& p : mesh.positions) surface.positions.push_back((Vec3d(p) - mean) / unit);
  return surface;
}

bool measure_faces(const Context& context, std::span<const Triangle> triangles,
                   std::span<const Vec3d> positions, FaceGeometry& faces) {
  faces.normals.resize(triangles.size());
  faces.centroids.resize(triangles.size());
  return parallel_for(context, triangles.size(), [&](IndexRange range) {
    for (std::size_t f = range.begin; f < range.end; ++f) {
      const auto [a, b, c] = triangles[f];
      const Vec3d p = positions[a], q = positions[b], r = positions[c];
      const Vec3d direction = cross(q - p, r - p);
      const double length = norm(direction);
      const auto area = static_cast<float>(length / 2);
      faces.normals[f] = area > 0 ? Quad(Vec3f(direction * (1 / length)), area) : Quad();
      faces.centroids[f] = Quad(Vec3f((p + q + r) * (1. / 3)), 0);
    }
  });
}

}  // namespace burnish
