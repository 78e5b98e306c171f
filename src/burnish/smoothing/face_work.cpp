#include "burnish/smoothing/face_work.h"

#include <utility>

#include "burnish/smoothing/face_neighbours.h"
#include "burnish/smoothing/smoothing_weights.h"

namespace burnish {

Context for_passes_over(std::size_t faces, const Context& context) {
  constexpr std::size_t kFew = 32768;  // about 0.1 ms a pass
  Context result = context;
  if (faces <= kFew) result.threads = 1;
  return result;
}

Result<FaceWork> begin_face_work(const TriangleMesh& mesh, const Context& context) {
  if (auto sound = check(mesh); !sound) return sound.error();
  Result<std::vector<float>> follows = smoothing_weights(mesh);
  if (!follows) return follows.error();
  FaceWork work;
  work.follows = std::move(*follows);
  work.faces_of_vertices = triangles_of_vertices(mesh);
  if (!edge_neighbours(context.part(0, 0.3), mesh, work.faces_of_vertices, work.edge_neighbours) ||
      !vertex_neighbours(context.part(0.3, 1), mesh, work.faces_of_vertices, work.edge_neighbours,
                         work.vertex_neighbours)) {
    return cancelled();
  }
  work.surface = face_surface(mesh, mean_centroid_distance(mesh, work.edge_neighbours));
  return work;
}

SmoothingReport finish_face_work(TriangleMesh& mesh, const FaceSurface& surface,
                                 std::span<const Vec3d> positions, int iterations) {
  std::vector<Vec3f> moved = mesh.positions;
  for (std::size_t v = 0; v < moved.size(); ++v) {
    const Vec3d move = surface.unit * (positions[v] - surface.positions[v]);
    moved[v] = Vec3f(Vec3d(moved[v]) + move);
  }
  std::swap(mesh.positions, moved);
  if (!mesh.attributes.normals.empty()) mesh.attributes.normals = vertex_normals(mesh);
  return report_moves(moved, mesh, iterations);
}

}  // namespace burnish
