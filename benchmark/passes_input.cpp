#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <numeric>
#include <string>

#include "burnish/base/random.h"
#include "burnish/core/adjacency.h"
#include "burnish/io/geometry_file.h"
#include "burnish/shapes/shapes.h"

// burnish_benchmark_passes_input MESH|torus SUBDIVISIONS file|random OUT: a mesh for the programs
// that time passes (peers/passes_peer.h). `torus` has 652 864 triangles, half of whose squares are
// cut along one diagonal and half along the other by chance, so that vertices have four to eight
// neighbours; each subdivision cuts every triangle in four and appends the vertices. With `random`
// vertices are numbered at random.
namespace burnish {
namespace {

/// Turns the diagonals of half of the squares, which consecutive triangles make up.
void turn_diagonals(TriangleMesh& mesh) {
  Random random(1);
  for (std::size_t t = 0; t + 1 < mesh.triangles.size(); t += 2) {
    Triangle &one = mesh.triangles[t], &other = mesh.triangles[t + 1];
    const auto apart = [](const Triangle& a, const Triangle& b) {
      std::size_t i = 0;
      while (i < 3 && std::find(b.begin(), b.end(), a[i]) != b.end()) ++i;
      return i;
    };
    const std::size_t i = apart(one, other), k = apart(other, one);
    if (random.uniform() < 0.5 || i == 3 || k == 3) continue;
    const std::uint32_t a = one[i], p = one[(i + 1) % 3], q = one[(i + 2) % 3], b = other[k];
    one = {a, p, b};
    other = {a, b, q};
  }
}

TriangleMesh subdivided(const TriangleMesh& mesh) {
  const Adjacency rings = one_rings(mesh);
  TriangleMesh finer;
  finer.positions = mesh.positions;
  std::vector<std::uint32_t> middles(rings.items().size(), 0);  // of an edge; 0: none yet
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto row = rings.row(std::min(a, b));
    const auto place = std::lower_bound(row.begin(), row.end(), std::max(a, b)) - row.begin();
    std::uint32_t& v = middles[rings.offsets()[std::min(a, b)] + static_cast<std::size_t>(place)];
    if (v == 0) {
      v = static_cast<std::uint32_t>(finer.positions.size());
      finer.positions.push_back(0.5f * (mesh.positions[a] + mesh.positions[b]));
    }
    return v;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    finer.triangles.insert(finer.triangles.end(),
                           {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return finer;
}

void number_at_random(TriangleMesh& mesh) {
  std::vector<std::uint32_t> numbers(mesh.positions.size());
  std::iota(numbers.begin(), numbers.end(), 0u);
  Random random(2);
  for (std::size_t i = numbers.size(); i > 1; --i) {
    std::swap(numbers[i - 1], numbers[random.below(i)]);
  }
  const std::vector<Vec3f> positions = mesh.positions;
  for (std::size_t v = 0; v < numbers.size(); ++v) mesh.positions[numbers[v]] = positions[v];
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& v : t) v = numbers[v];
  }
}

/// So that nobody is tied with anybody.
void add_noise(TriangleMesh& mesh) {
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    Random random(3, v);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      mesh.positions[v][axis] += static_cast<float>(1e-4 * random.normal());
    }
  }
}

TriangleMesh torus() {
  TriangleMesh mesh = make_torus(1, 0.4, 808, 404);
  turn_diagonals(mesh);
  return mesh;
}

}  // namespace
}  // namespace burnish

int main(int argc, char** argv) {
  using namespace burnish;
  if (argc != 5) return 2;
  TriangleMesh mesh;
  if (std::string(argv[1]) == "torus") {
    mesh = torus();
    for (int i = 0; i < std::atoi(argv[2]); ++i) mesh = subdivided(mesh);
    add_noise(mesh);
  } else {
    Result<TriangleMesh> file = read_mesh(argv[1]);
    if (!file) return 1;
    mesh = *std::move(file);
  }
  if (std::string(argv[3]) == "random") number_at_random(mesh);
  std::ofstream out(argv[4], std::ios::binary);
  const std::uint64_t counts[2] = {mesh.positions.size(), mesh.triangles.size()};
  out.write(reinterpret_cast<const char*>(counts), sizeof(counts));
  out.write(reinterpret_cast<const char*>(mesh.positions.data()),
            static_cast<std::streamsize>(counts[0] * sizeof(Vec3f)));
  out.write(reinterpret_cast<const char*>(mesh.triangles.data()),
            static_cast<std::streamsize>(counts[1] * sizeof(Triangle)));
  return out ? 0 : 1;
}
