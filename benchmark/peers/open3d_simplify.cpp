#include <open3d/geometry/TriangleMesh.h>

#include <limits>

#include "simplify_peer.h"

// SimplifyQuadricDecimation with its defaults.
int main(int argc, char** argv) {
  if (argc != 4) return 2;
  return run_simplify_peer(
      argv, [](const PlainMesh& plain, std::size_t triangles, Measurement& measurement) {
        open3d::geometry::TriangleMesh mesh;
        mesh.vertices_.reserve(plain.positions.size());
        mesh.triangles_.reserve(plain.triangles.size());
        for (const auto& p : plain.positions) mesh.vertices_.emplace_back(p[0], p[1], p[2]);
        for (const auto& t : plain.triangles) {
          mesh.triangles_.emplace_back(static_cast<int>(t[0]), static_cast<int>(t[1]),
                                       static_cast<int>(t[2]));
        }
        measurement.begin_alone();
        const auto simplified = mesh.SimplifyQuadricDecimation(
            static_cast<int>(triangles), std::numeric_limits<double>::infinity(), 1);
        measurement.end_alone();
        PlainMesh result;
        for (const Eigen::Vector3d& p : simplified->vertices_) {
          result.positions.push_back(
              {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
        }
        for (const Eigen::Vector3i& t : simplified->triangles_) {
          result.triangles.push_back({static_cast<std::uint32_t>(t[0]),
                                      static_cast<std::uint32_t>(t[1]),
                                      static_cast<std::uint32_t>(t[2])});
        }
        return result;
      });
}
