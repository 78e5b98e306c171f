#include "openmesh_smoothing.h"
#include "passes_peer.h"

// The adjacency is the half-edge mesh; the mean is JacobiLaplaceSmootherT.
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
    equation1_passes(mesh, kPasses);
  } else {
    own_passes(mesh, kPasses);
  }
  passes.print();
}
