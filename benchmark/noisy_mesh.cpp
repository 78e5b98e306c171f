#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "burnish/base/random.h"
#include "burnish/core/edges.h"
#include "burnish/io/geometry_file.h"
#include "burnish/spatial/neighbour_grid.h"
#include "judged_shapes.h"

// burnish_benchmark_noisy                                   prints the names of the shapes
// burnish_benchmark_noisy SHAPE TRUTH                       writes one
// burnish_benchmark_noisy SHAPE TRUTH NOISY LEVEL KIND SEED and the same with noise along its
//   normals, whose standard deviation is LEVEL mean edges. KIND is white, or correlated as measured
//   on a real Kinect frame with known truth (burnish/sensor/image_noise.h), an edge for a pixel:
//   0.32 of the variance white, 0.46 blurred by one edge, 0.22 by five.
namespace burnish {
namespace {

struct Part {
  double share;  ///< of the variance
  double blur;   ///< mean edges
};
constexpr Part kWhite[] = {{1, 0}};
constexpr Part kCorrelated[] = {{0.32, 0}, {0.46, 1}, {0.22, 5}};

/// Normal random numbers of variance 1, one for each vertex, blurred by a Gaussian in space.
std::vector<double> blurred(const TriangleMesh& mesh, double radius, std::uint64_t seed) {
  std::vector<double> white;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    white.push_back(Random(seed, v).normal());
  }
  if (radius == 0) return white;
  const NeighbourGrid grid(mesh.positions);
  std::vector<double> result;
  std::vector<Neighbour> near;
  for (const Vec3f& p : mesh.positions) {
    grid.within(p, 3 * radius, near);
    double sum = 0, squares = 0;
    for (const Neighbour& n : near) {
      const double weight = std::exp(-n.squared_distance / (2 * radius * radius));
      sum += weight * white[n.index];
      squares += weight * weight;
    }
    result.push_back(sum / std::sqrt(squares));
  }
  return result;
}

TriangleMesh with_noise(const TriangleMesh& truth, double level, std::span<const Part> parts,
                        std::uint64_t seed) {
  const double edge = mean_edge_length(truth);
  const std::vector<Vec3f> normals = vertex_normals(truth);
  std::vector<double> heights(truth.positions.size());
  for (const Part& part : parts) {
    const std::vector<double> field = blurred(truth, part.blur * edge, seed++);
    for (std::size_t v = 0; v < heights.size(); ++v) {
      heights[v] += level * edge * std::sqrt(part.share) * field[v];
    }
  }
  TriangleMesh noisy = truth;
  for (std::size_t v = 0; v < heights.size(); ++v) {
    noisy.positions[v] = Vec3f(Vec3d(truth.positions[v]) + heights[v] * Vec3d(normals[v]));
  }
  return noisy;
}

int fail(const Error& error) {
  std::fprintf(stderr, "%s %s\n", error.where.c_str(), error.message.c_str());
  return 1;
}

}  // namespace
}  // namespace burnish

int main(int argc, char** argv) {
  using namespace burnish;
  if (argc == 1) {
    for (const std::string_view name : judged_shapes()) std::puts(std::string(name).c_str());
    return 0;
  }
  if (argc != 3 && argc != 7) return 2;
  const Result<TriangleMesh> truth = judged_shape(argv[1]);
  if (!truth) return fail(truth.error());
  if (auto written = write_mesh(argv[2], *truth); !written) return fail(written.error());
  if (argc == 3) return 0;
  const std::string kind = argv[5];
  if (kind != "white" && kind != "correlated") return 2;
  const std::span<const Part> parts = kind == "white" ? std::span<const Part>(kWhite) : kCorrelated;
  const TriangleMesh noisy =
      with_noise(*truth, std::atof(argv[4]), parts, std::strtoull(argv[6], nullptr, 10));
  if (auto written = write_mesh(argv[3], noisy); !written) return fail(written.error());
}
