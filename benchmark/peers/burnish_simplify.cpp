#include "burnish/adaptation/point_removal.h"
#include "burnish/adaptation/quadric_collapse.h"
#include "simplify_peer.h"

// simplify_burnish MESH OUT.ply TRIANGLES quadric|point_removal THREADS: as the peers do
// (simplify_peer.h). The arrays are those of burnish's own mesh, which is edited in place.
int main(int argc, char** argv) {
  using namespace burnish;
  if (argc != 6) return 2;
  TriangleMesh mesh;
  {
    PlainMesh plain = read_plain_mesh(argv[1]);
    for (const auto& [x, y, z] : plain.positions) mesh.positions.push_back({x, y, z});
    mesh.positions.shrink_to_fit();
    mesh.triangles = std::move(plain.triangles);
  }
  SimplifyParams params;
  params.target_triangles = std::atoi(argv[3]);
  Context context;
  context.threads = std::atoi(argv[5]);
  const bool quadric = std::string(argv[4]) == "quadric";
  Measurement measurement;
  measurement.begin_alone();
  const auto report = quadric ? simplify_quadric(mesh, params, context)
                              : simplify_point_removal(mesh, params, context);
  measurement.end_alone();
  measurement.print();
  if (!report) {
    std::fprintf(stderr, "%s\n", report.error().message.c_str());
    return 1;
  }
  PlainMesh result;
  for (const Vec3f& p : mesh.positions) result.positions.push_back({p.x, p.y, p.z});
  result.triangles = std::move(mesh.triangles);
  write_ply(argv[2], result);
}
