#include <meshoptimizer.h>

#include "simplify_peer.h"

// meshopt_simplify with no limit to its error. It gives indices of the vertices that it was given;
// leaving out those that none uses is not counted.
int main(int argc, char** argv) {
  if (argc != 4) return 2;
  return run_simplify_peer(
      argv, [](const PlainMesh& mesh, std::size_t triangles, Measurement& measurement) {
        PlainMesh result;
        result.triangles.resize(mesh.triangles.size());
        measurement.begin_alone();
        const std::size_t indices = meshopt_simplify(
            result.triangles.data()->data(), mesh.triangles.data()->data(),
            3 * mesh.triangles.size(), mesh.positions.data()->data(), mesh.positions.size(),
            sizeof(mesh.positions[0]), 3 * triangles, 1e9f, 0, nullptr);
        measurement.end_alone();
        result.triangles.resize(indices / 3);
        result.positions = mesh.positions;
        return result;
      });
}
