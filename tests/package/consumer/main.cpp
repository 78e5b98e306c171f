#include <burnish/smoothing/one_ring_mean.h>

int main() {
  burnish::TriangleMesh mesh;
  mesh.positions = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}};
  const auto report = burnish::smooth_one_ring_mean(mesh);
  return report && report->moved_vertices == 1 && mesh.positions[0].z == 0.25f ? 0 : 1;
}
