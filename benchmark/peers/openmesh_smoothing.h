#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Smoother/JacobiLaplaceSmootherT.hh>
#include <vector>

#include "equation1.h"

// Passes in OpenMesh, boundaries fixed: of Eq. 1, and of the smoothing that it brings.
using Mesh = OpenMesh::TriMesh_ArrayKernelT<>;

inline void equation1_pass(Mesh& mesh, std::vector<Mesh::Point>& next) {
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

inline void equation1_passes(Mesh& mesh, int passes) {
  std::vector<Mesh::Point> next(mesh.n_vertices());
  for (int pass = 0; pass < passes; ++pass) equation1_pass(mesh, next);
}

inline void own_passes(Mesh& mesh, int passes) {
  OpenMesh::Smoother::JacobiLaplaceSmootherT<Mesh> smoother(mesh);
  using Smoother = OpenMesh::Smoother::SmootherT<Mesh>;
  smoother.initialize(Smoother::Tangential_and_Normal, Smoother::C0);
  smoother.smooth(static_cast<unsigned>(passes));
}
