#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Smoother/JacobiLaplaceSmootherT.hh>
#include <cstring>
#include <iostream>

#include "equation1.h"

// peer_openmesh IN OUT equation1|own: ten passes, boundaries fixed.
using Mesh = OpenMesh::TriMesh_ArrayKernelT<>;

static void equation1_pass(Mesh& mesh) {
  std::vector<Mesh::Point> next(mesh.n_vertices());
  for (const auto v : mesh.vertices()) {
    const Mesh::Point p = mesh.point(v);
    next[static_cast<std::size_t>(v.idx())] =
        mesh.is_boundary(v) ? p
                            : Mesh::Point(equation1(
                                  OpenMesh::Vec3d(p[0], p[1], p[2]), mesh.vv_range(v),
                                  [&](const auto& w) {
                                    const Mesh::Point& q = mesh.point(w);
                                    return OpenMesh::Vec3d(q[0], q[1], q[2]);
                                  },
                                  [](const OpenMesh::Vec3d& d) { return d.sqrnorm(); }));
  }
  for (const auto v : mesh.vertices()) mesh.set_point(v, next[static_cast<std::size_t>(v.idx())]);
}

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  Mesh mesh;
  if (!OpenMesh::IO::read_mesh(mesh, argv[1])) return 1;
  if (std::strcmp(argv[3], "equation1") == 0) {
    for (int pass = 0; pass < 10; ++pass) equation1_pass(mesh);
  } else {
    OpenMesh::Smoother::JacobiLaplaceSmootherT<Mesh> smoother(mesh);
    using Smoother = OpenMesh::Smoother::SmootherT<Mesh>;
    smoother.initialize(Smoother::Tangential_and_Normal, Smoother::C0);
    smoother.smooth(10);
  }
  return OpenMesh::IO::write_mesh(mesh, argv[2], OpenMesh::IO::Options::Binary) ? 0 : 1;
}
