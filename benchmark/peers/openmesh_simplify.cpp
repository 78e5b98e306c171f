#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include "simplify_peer.h"

// DecimaterT with ModQuadricT as the only module, which gives the priority (no limit to its error).
using Mesh = OpenMesh::TriMesh_ArrayKernelT<>;

static Mesh mesh_of(const PlainMesh& plain) {
  Mesh mesh;
  mesh.reserve(plain.positions.size(), 3 * plain.triangles.size() / 2, plain.triangles.size());
  for (const auto& p : plain.positions) mesh.add_vertex({p[0], p[1], p[2]});
  for (const auto& [a, b, c] : plain.triangles) {
    mesh.add_face(mesh.vertex_handle(a), mesh.vertex_handle(b), mesh.vertex_handle(c));
  }
  return mesh;
}

static PlainMesh plain_of(Mesh& mesh) {
  mesh.garbage_collection();
  PlainMesh plain;
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    plain.positions.push_back({p[0], p[1], p[2]});
  }
  for (const auto f : mesh.faces()) {
    auto& triangle = plain.triangles.emplace_back();
    std::size_t corner = 0;
    for (const auto v : mesh.fv_range(f)) triangle[corner++] = static_cast<std::uint32_t>(v.idx());
  }
  return plain;
}

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  return run_simplify_peer(
      argv, [](const PlainMesh& plain, std::size_t triangles, Measurement& measurement) {
        Mesh mesh = mesh_of(plain);
        measurement.begin_alone();
        OpenMesh::Decimater::DecimaterT<Mesh> decimater(mesh);
        OpenMesh::Decimater::ModQuadricT<Mesh>::Handle quadric;
        decimater.add(quadric);
        decimater.module(quadric).unset_max_err();
        decimater.initialize();
        decimater.decimate_to_faces(0, triangles);
        measurement.end_alone();
        return plain_of(mesh);
      });
}
