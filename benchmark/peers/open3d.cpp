#include <open3d/geometry/TriangleMesh.h>
#include <open3d/io/TriangleMeshIO.h>

#include <cstring>

#include "equation1.h"

// peer_open3d IN OUT equation1|own: ten passes, boundaries fixed in equation1.
using open3d::geometry::TriangleMesh;

static std::vector<bool> boundary(const TriangleMesh& mesh) {
  std::vector<bool> result(mesh.vertices_.size());
  for (const Eigen::Vector2i& edge : mesh.GetNonManifoldEdges(false)) {
    result[static_cast<std::size_t>(edge[0])] = result[static_cast<std::size_t>(edge[1])] = true;
  }
  return result;
}

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  auto mesh = std::make_shared<TriangleMesh>();
  if (!open3d::io::ReadTriangleMesh(argv[1], *mesh)) return 1;
  if (std::strcmp(argv[3], "equation1") == 0) {
    mesh->ComputeAdjacencyList();
    const std::vector<bool> fixed = boundary(*mesh);
    std::vector<Eigen::Vector3d> next = mesh->vertices_;
    for (int pass = 0; pass < 10; ++pass) {
      for (std::size_t v = 0; v < next.size(); ++v) {
        if (fixed[v]) continue;
        next[v] = equation1(
            mesh->vertices_[v], mesh->adjacency_list_[v],
            [&](int w) { return mesh->vertices_[static_cast<std::size_t>(w)]; },
            [](const Eigen::Vector3d& d) { return d.squaredNorm(); });
      }
      std::swap(mesh->vertices_, next);
    }
  } else {
    mesh = mesh->FilterSmoothSimple(10);
  }
  return open3d::io::WriteTriangleMesh(argv[2], *mesh) ? 0 : 1;
}
