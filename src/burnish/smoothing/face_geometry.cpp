#include "burnish/smoothing/face_geometry.h"

#include "burnish/base/parallel.h"
#include "burnish/core/edges.h"

namespace burnish {
namespace {

Vec3d centroid(std::span<const Vec3d> positions, const Triangle& t) {
  return (positions[t[0]] + positions[t[1]] + positions[t[2]]) / 3.;
}

double mean_centroid_distance(const TriangleMesh& mesh, std::span<const Vec3d> positions,
                              const Adjacency& edge_neighbours) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t f = 0; f < edge_neighbours.size(); ++f) {
    const Vec3d own = centroid(positions, mesh.triangles[f]);
    for (const std::uint32_t g : edge_neighbours.row(f)) {
      if (g < f) continue;
      sum += norm(centroid(positions, mesh.triangles[g]) - own);
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

}  // namespace

FaceSurface face_surface(const TriangleMesh& mesh, const Adjacency& edge_neighbours) {
  FaceSurface surface;
  Vec3d mean;
  for (const Vec3f& p : mesh.positions) mean += Vec3d(p);
  if (!mesh.positions.empty()) mean = mean / static_cast<double>(mesh.positions.size());
  surface.positions.reserve(mesh.positions.size());
  for (const Vec3f& p : mesh.positions) surface.positions.push_back(Vec3d(p) - mean);

  surface.unit = mean_centroid_distance(mesh, surface.positions, edge_neighbours);
  if (!(surface.unit > 0)) surface.unit = mean_edge_length(mesh);
  if (!(surface.unit > 0)) surface.unit = 1;
  for (Vec3d& p : surface.positions) p = p / surface.unit;
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
