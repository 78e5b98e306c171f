#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Smoother/JacobiLaplaceSmootherT.hh>

#include "equation1.h"
#include "passes_peer.h"

// The adjacency is the half-edge mesh; the mean is JacobiLaplaceSmootherT.
using Mesh = OpenMesh::TriMesh_ArrayKernelT<>;

static void equation1_pass(Mesh& mesh, std::vector<Mesh::Point>& next) {
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
  const bool equation = wants_equation1(argc, argv);
  const PlainMesh plain = read_plain_mesh(argv[1]);
  const Stopwatch adjacency;
  Mesh mesh;
  mesh.reserve(plain.positions.size(), 3 * plain.triangles.size() / 2, plain.triangles.size());
  for (const auto& p : plain.positions) mesh.add_vertex({p[0], p[1], p[2]});
  for (const auto& t : plain.triangles) {
    mesh.add_face(mesh.vertex_handle(t[0]), mesh.vertex_handle(t[1]), mesh.vertex_handle(t[2]));
  }
  adjacency.print();
  const Stopwatch passes;
  if (equation) {
    std::vector<Mesh::Point> next(mesh.n_vertices());
    for (int pass = 0; pass < kPasses; ++pass) equation1_pass(mesh, next);
  } else {
    OpenMesh::Smoother::JacobiLaplaceSmootherT<Mesh> smoother(mesh);
    using Smoother = OpenMesh::Smoother::SmootherT<Mesh>;
    smoother.initialize(Smoother::Tangential_and_Normal, Smoother::C0);
    smoother.smooth(kPasses);
  }
  passes.print();
}
