// The progressive file: what was written comes back to the bit, at every level, and nothing else.
#include "burnish/pipeline/progressive_file.h"

#include <gtest/gtest.h>

#include "burnish/io/geometry_file.h"
#include "burnish/shapes/shapes.h"
#include "io/samples.h"
#include "support/bunny.h"
#include "support/progress.h"
#include "support/random_mesh.h"
#include "support/random_removals.h"

namespace burnish {
namespace {

struct Sample {
  std::string name;
  TriangleMesh mesh;
  std::vector<Removal> removals;
};

Sample sample_of(const std::string& name, TriangleMesh mesh, std::uint64_t seed = 1,
                 std::size_t tries_per_vertex = 20) {
  const std::size_t tries = tries_per_vertex * mesh.positions.size();
  std::vector<Removal> removals = test::RandomCollapser(mesh, seed).removals(tries);
  return {name, std::move(mesh), std::move(removals)};
}

TriangleMesh with_everything(TriangleMesh mesh, std::uint64_t seed) {
  mesh.attributes = test::any_attributes(seed, mesh.positions.size());
  mesh.triangle_attributes =
      test::any_triangle_attributes(seed, mesh.triangles.size(), mesh.positions.size());
  mesh.frame.origin = {4.5e6, -1.25, 0.1};
  return mesh;
}

/// Vertices and triangles in another order, triangles begun at another corner.
TriangleMesh shuffled(const TriangleMesh& mesh, std::uint64_t seed) {
  Random random(seed);
  const auto permutation = [&](std::size_t count) {
    std::vector<std::uint32_t> order(count);
    for (std::uint32_t i = 0; i < count; ++i) order[i] = i;
    for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    return order;
  };
  const std::vector<std::uint32_t> vertices = permutation(mesh.positions.size());
  TriangleMesh result = mesh;
  for (std::size_t v = 0; v < vertices.size(); ++v)
    result.positions[vertices[v]] = mesh.positions[v];
  keep_triangles(result, permutation(mesh.triangles.size()));
  for (Triangle& triangle : result.triangles) {
    for (std::uint32_t& v : triangle) v = vertices[v];
    const auto turn = static_cast<std::ptrdiff_t>(random.below(3));
    std::rotate(triangle.begin(), triangle.begin() + turn, triangle.end());
  }
  return result;
}

/// Several spheres, grids with boundaries, loose and odd triangles, in one mesh.
TriangleMesh motley_mesh(std::uint64_t seed) {
  TriangleMesh mesh;
  const auto add = [&](const TriangleMesh& part) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
    for (const auto& [a, b, c] : part.triangles)
      mesh.triangles.push_back({a + first, b + first, c + first});
  };
  add(make_sphere(1, 2));
  add(make_grid(5, 4));
  add(test::random_mesh(12, 20, seed));
  add(make_uv_sphere(1, 40, 4));  // poles with stars above what a mask tells
  add(make_grid(1, 1));
  mesh.triangles.push_back({0, 5, 70});  // an edge of three triangles, most likely
  mesh.triangles.push_back(mesh.triangles[3]);
  mesh.triangles.push_back({7, 7, 9});
  return shuffled(mesh, seed);
}

std::vector<Sample> samples() {
  std::vector<Sample> all;
  all.push_back(sample_of("sphere", make_sphere(1, 3)));
  all.push_back(sample_of("open grid", make_grid(12, 9)));
  all.push_back(
      sample_of("torus, everything known", with_everything(make_torus(1, 0.4, 16, 8), 3)));
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    all.push_back(sample_of("motley " + std::to_string(seed),
                            with_everything(motley_mesh(seed), seed), seed, 3 * seed));
  }
  all.push_back(sample_of("nothing", {}));
  all.push_back(sample_of("points", {{{1, 2, 3}, {4, 5, 6}}, {}, {}, {}, {}}));
  Sample untouched = sample_of("nothing removed", make_sphere(1, 1), 1, 0);
  untouched.mesh.attributes.channels = {{"empty", std::vector<double>{}},
                                        {"", std::vector<std::int8_t>(42)}};
  all.push_back(std::move(untouched));
  return all;
}

std::string written(const Sample& sample) {
  const test::TemporaryFolder folder;
  const auto report = write_progressive(folder / "mesh.bpm", sample.mesh, sample.removals);
  EXPECT_TRUE(report) << report.error().text();
  const std::string bytes = test::slurp(folder / "mesh.bpm");
  if (report) EXPECT_EQ(report->bytes, bytes.size());
  return bytes;
}

Result<ProgressiveLevel> parsed(std::string_view bytes, const ProgressiveStop& stop = {}) {
  // A buffer of exactly this size, so that a sanitizer sees a read beyond it.
  const std::vector<char> exact(bytes.begin(), bytes.end());
  return parse_progressive({exact.data(), exact.size()}, "sample", stop);
}

/// Where the coarse mesh and each record end.
std::vector<std::size_t> ends_of_levels(const std::string& bytes) {
  std::vector<std::size_t> ends;
  for (std::size_t size = 1; size <= bytes.size(); ++size) {
    const auto level = parsed(std::string_view(bytes).substr(0, size));
    if (level) ends.push_back(size);
  }
  return ends;
}

TEST(ProgressiveFile, GivesTheOriginalBack) {
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.name);
    const auto level = parsed(written(sample));
    ASSERT_TRUE(level) << level.error().text();
    EXPECT_TRUE(level->original);
    EXPECT_EQ(level->records, sample.removals.size());
    EXPECT_EQ(level->error, 0);
    EXPECT_TRUE(level->notes.empty());
    EXPECT_TRUE(level->mesh == sample.mesh);
    EXPECT_TRUE(test::same_bits(level->mesh.positions, sample.mesh.positions));
    EXPECT_TRUE(test::same_bits(level->mesh.attributes.noise, sample.mesh.attributes.noise));
  }
}

TEST(ProgressiveFile, HasSamplesThatAreMuchReduced) {
  for (const Sample& sample : samples()) {
    if (sample.name == "sphere" || sample.name == "open grid")
      EXPECT_GT(sample.removals.size(), sample.mesh.positions.size() * 8 / 10) << sample.name;
    if (sample.name.starts_with("motley")) EXPECT_GT(sample.removals.size(), 100u) << sample.name;
  }
}

}  // namespace
}  // namespace burnish
