#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include "simplify_peer.h"

// simplify_cgal MESH OUT.ply TRIANGLES lindstrom_turk|garland_heckbert: edge_collapse with its
// default cost and placement (Lindstrom and Turk's), or the plane policies of Garland and Heckbert.
// Its stop predicates count edges; this one counts triangles.
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace simplification = CGAL::Surface_mesh_simplification;

struct StopAtTriangles {
  std::size_t triangles;

  template <class Cost, class Profile>
  bool operator()(const Cost&, const Profile& profile, std::size_t, std::size_t) const {
    return profile.surface_mesh().number_of_faces() <= triangles;
  }
};

Mesh mesh_of(const PlainMesh& plain) {
  Mesh mesh;
  mesh.reserve(plain.positions.size(), 3 * plain.triangles.size() / 2, plain.triangles.size());
  for (const auto& p : plain.positions) mesh.add_vertex({p[0], p[1], p[2]});
  std::size_t refused = 0;
  for (const auto& [a, b, c] : plain.triangles) {
    refused += mesh.add_face(Mesh::Vertex_index(a), Mesh::Vertex_index(b), Mesh::Vertex_index(c)) ==
               Mesh::null_face();
  }
  if (refused > 0) std::fprintf(stderr, "%zu triangles are no surface and left out\n", refused);
  return mesh;
}

PlainMesh plain_of(Mesh& mesh) {
  mesh.collect_garbage();
  PlainMesh plain;
  plain.positions.reserve(mesh.number_of_vertices());
  plain.triangles.reserve(mesh.number_of_faces());
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    plain.positions.push_back(
        {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
  }
  for (const auto f : mesh.faces()) {
    auto& triangle = plain.triangles.emplace_back();
    std::size_t corner = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) triangle[corner++] = v;
  }
  return plain;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  const bool planes = std::string(argv[4]) == "garland_heckbert";
  return run_simplify_peer(argv, [planes](const PlainMesh& plain, std::size_t triangles,
                                          Measurement& measurement) {
    Mesh mesh = mesh_of(plain);
    measurement.begin_alone();
    if (planes) {
      const simplification::GarlandHeckbert_plane_policies<Mesh, Kernel> policies(mesh);
      simplification::edge_collapse(
          mesh, StopAtTriangles{triangles},
          CGAL::parameters::get_cost(policies.get_cost()).get_placement(policies.get_placement()));
    } else {
      simplification::edge_collapse(mesh, StopAtTriangles{triangles});
    }
    measurement.end_alone();
    return plain_of(mesh);
  });
}
