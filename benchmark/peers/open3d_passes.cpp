#include <open3d/geometry/TriangleMesh.h>

#include "equation1.h"
#include "passes_peer.h"

// The adjacency is ComputeAdjacencyList (with GetNonManifoldEdges for Eq. 1, whose boundaries
// stay); the mean is FilterSmoothSimple.
using open3d::geometry::TriangleMesh;

int main(int argc, char** argv) {
  const bool equation = wants_equation1(argc, argv);
  const PlainMesh plain = read_plain_mesh(argv[1]);
  TriangleMesh mesh;
  for (const auto& p : plain.positions) mesh.vertices_.emplace_back(p[0], p[1], p[2]);
  for (const auto& t : plain.triangles) {
    mesh.triangles_.emplace_back(static_cast<int>(t[0]), static_cast<int>(t[1]),
                                 static_cast<int>(t[2]));
  }
  const Stopwatch adjacency;
  mesh.ComputeAdjacencyList();
  std::vector<bool> fixed(mesh.vertices_.size());
  if (equation) {
    for (const Eigen::Vector2i& edge : mesh.GetNonManifoldEdges(false)) {
      fixed[static_cast<std::size_t>(edge[0])] = fixed[static_cast<std::size_t>(edge[1])] = true;
    }
  }
  adjacency.print();
  const Stopwatch passes;
  if (equation) {
    std::vector<Eigen::Vector3d> next = mesh.vertices_;
    for (int pass = 0; pass < kPasses; ++pass) {
      for (std::size_t v = 0; v < next.size(); ++v) {
        if (fixed[v]) continue;
        next[v] = equation1(
            mesh.vertices_[v], mesh.adjacency_list_[v],
            [&](int w) { return mesh.vertices_[static_cast<std::size_t>(w)]; },
            [](const Eigen::Vector3d& d) { return d.squaredNorm(); });
      }
      std::swap(mesh.vertices_, next);
    }
  } else {
    mesh.FilterSmoothSimple(kPasses);
  }
  passes.print();
}
