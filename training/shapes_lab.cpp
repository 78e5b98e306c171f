#include <cstdio>
#include "implicit_shape.h"
#include "burnish/core/topology.h"
#include "burnish/core/edges.h"
#include "burnish/io/geometry_file.h"
using namespace burnish; using namespace burnish::training;
int main(int, char** argv) {
  for (int s = 0; s < 12; ++s) { Random r(100 + s); auto solid = random_solid(r); auto m = surface_of(*solid, 0.03, r); auto t = topology(m);
    std::printf("%d: %zu vertices %zu triangles comp %zu bedges %zu edge %.4f\n", s, m.positions.size(), m.triangles.size(), t.components, t.boundary_edges, mean_edge_length(m));
    GeometryFile g; (void)g; auto w = write_mesh(std::string(argv[1]) + "/shape" + std::to_string(s) + ".ply", m); if (!w) std::printf("%s\n", w.error().text().c_str()); }
}
