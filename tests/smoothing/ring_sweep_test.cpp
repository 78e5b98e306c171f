#include "burnish/smoothing/ring_sweep.h"

#include <gtest/gtest.h>

#include <numeric>

#include "burnish/shapes/shapes.h"
#include "burnish/smoothing/nearest_farthest.h"
#include "burnish/smoothing/one_ring_mean.h"
#include "burnish/smoothing/ring_mesh.h"
#include "support/plain_smoothing.h"

namespace burnish {
namespace {

/// The same mesh with its vertices numbered at random.
TriangleMesh numbered_at_random(TriangleMesh mesh, std::uint64_t seed) {
  std::vector<std::uint32_t> numbers(mesh.positions.size());
  std::iota(numbers.begin(), numbers.end(), 0u);
  Random random(seed);
  for (std::size_t i = numbers.size(); i > 1; --i) {
    std::swap(numbers[i - 1], numbers[random.below(i)]);
  }
  const std::vector<Vec3f> positions = mesh.positions;
  for (std::size_t v = 0; v < numbers.size(); ++v) mesh.positions[numbers[v]] = positions[v];
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& v : t) v = numbers[v];
  }
  return mesh;
}

/// Closed and open, in good order and in none, with every defect, and with vertices of no triangle.
std::vector<TriangleMesh> samples() {
  std::vector<TriangleMesh> meshes{
      {},
      make_grid(1, 1),
      test::with_noise(make_torus(1, 0.4, 40, 25), 0.01, 1),
      test::with_noise(make_sphere(1, 3), 0.01, 2),
      numbered_at_random(test::with_noise(make_sphere(1, 3), 0.01, 3), 4),
      test::with_noise(make_grid(30, 17), 0.1, 5),
      test::random_mesh(300, 200, 6),
      test::random_mesh(50, 400, 7),
  };
  TriangleMesh two = meshes[2];  // parts, and vertices of none
  two.positions.resize(two.positions.size() + 9);
  meshes.push_back(std::move(two));
  return meshes;
}

/// One pass as plainly as can be: neighbours are added up in rising order.
std::vector<Vec3d> plain_pass(const test::PlainRings& rings, const std::vector<Vec3d>& positions) {
  std::vector<Vec3d> next = positions;
  for (std::size_t v = 0; v < rings.size(); ++v) {
    if (rings[v].empty()) continue;
    Vec3d sum = positions[v];
    for (const std::uint32_t w : rings[v]) sum += positions[w];
    next[v] = sum / (1 + static_cast<double>(rings[v].size()));
  }
  return next;
}

std::vector<Vec3d> swept(const TriangleMesh& mesh, int passes, const SweepLayout& layout,
                         int threads) {
  Context context;
  context.threads = threads;
  Result<SweptMesh> work = swept_mesh(mesh, BoundaryRule::fixed, passes, context, layout);
  EXPECT_TRUE(work);
  LargeVector<Vec3d> other(work->positions.size());
  const bool done = work->sweep.run(context, passes, [&](int pass, const RingTile& tile) {
    const auto& now = pass % 2 == 0 ? work->positions : other;
    auto& next = pass % 2 == 0 ? other : work->positions;
    tile.for_each([&](std::uint32_t v, std::span<const std::uint32_t> ring) {
      Vec3d sum = now[v];
      for (const std::uint32_t w : ring) sum += now[w];
      next[v] = ring.empty() ? now[v] : sum / (1 + static_cast<double>(ring.size()));
    });
  });
  EXPECT_TRUE(done);
  const auto& last = passes % 2 == 0 ? work->positions : other;
  return work->sweep.given_back(std::vector<Vec3d>(last.begin(), last.end()));
}

TEST(RingSweep, IsAPlainLoopToTheLastBit) {
  for (const TriangleMesh& mesh : samples()) {
    const test::PlainRings rings = test::plain_rings(mesh, BoundaryRule::fixed);
    std::vector<Vec3d> expected = test::plain_positions(mesh);
    int made = 0;
    for (const int passes : {0, 1, 3, 5, 10, 37}) {
      for (; made < passes; ++made) expected = plain_pass(rings, expected);
      for (const unsigned bits : {0u, 3u, 6u, 11u}) {
        // None: everything is far. A little: some passes go together. Much: all fits.
        for (const std::size_t cache : {std::size_t{0}, std::size_t{40000}, std::size_t{1} << 23}) {
          for (const Numbering numbering : {Numbering::as_given, Numbering::near}) {
            const SweepLayout layout{numbering, bits, cache};
            ASSERT_EQ(swept(mesh, passes, layout, 1), expected)
                << passes << " passes, tiles of 2^" << bits << ", cache of " << cache;
          }
        }
      }
    }
  }
}

TEST(RingSweep, IsTheSameForEveryNumberOfThreads) {
  // Less than this is done on one thread whatever the context says.
  const TriangleMesh mesh = numbered_at_random(make_sphere(1, 6), 1);
  for (const std::size_t cache : {std::size_t{0}, std::size_t{300000}}) {
    const SweepLayout layout{.tile_bits = 7, .cache = cache};
    ASSERT_FALSE(is_little_work(6 * mesh.positions.size(), 20));
    const std::vector<Vec3d> expected = swept(mesh, 20, layout, 1);
    for (const int threads : {2, 3, 8}) EXPECT_EQ(swept(mesh, 20, layout, threads), expected);
  }
}

TEST(RingSweep, NumbersValuesAndGivesThemBack) {
  for (const TriangleMesh& mesh : samples()) {
    std::vector<int> values(mesh.positions.size());
    std::iota(values.begin(), values.end(), 0);
    RingSweep sweep;
    ASSERT_TRUE(sweep.lay_out({}, one_rings(mesh), 10, {.tile_bits = 3, .cache = 1000}));
    const std::vector<int> taken = sweep.taken_over(values);
    EXPECT_EQ(sweep.given_back(taken), values);
    for (std::size_t v = 0; v < taken.size(); ++v) {
      EXPECT_EQ(static_cast<std::size_t>(taken[v]), sweep.in_mesh(v));
    }
  }
}

TEST(RingSweep, IsStoppedByACancelledContext) {
  std::stop_source stop;
  Context context;
  context.stop = stop.get_token();
  const TriangleMesh mesh = numbered_at_random(make_sphere(1, 4), 1);
  RingSweep sweep;
  ASSERT_TRUE(sweep.lay_out(context, one_rings(mesh), 10, {.tile_bits = 3}));
  int tiles = 0;
  EXPECT_FALSE(sweep.run(context, 10, [&](int, const RingTile&) {
    ++tiles;
    stop.request_stop();
  }));
  EXPECT_EQ(tiles, 1);
  EXPECT_FALSE(sweep.lay_out(context, one_rings(mesh), 10, {.tile_bits = 3, .cache = 0}));
}

TEST(RingSweep, MakesNoDifferenceToTheMean) {
  for (const TriangleMesh& before : samples()) {
    const test::PlainRings rings = test::plain_rings(before, BoundaryRule::fixed);
    std::vector<Vec3d> expected = test::plain_positions(before);
    for (int pass = 0; pass < 10; ++pass) expected = plain_pass(rings, expected);
    TriangleMesh mesh = before;
    ASSERT_TRUE(smooth_one_ring_mean(mesh, {.iterations = 10}));
    for (std::size_t v = 0; v < expected.size(); ++v) {
      ASSERT_EQ(mesh.positions[v], Vec3f(expected[v]));
    }
  }
}

TEST(RingSweep, MakesNoDifferenceToEquationOne) {
  // Where nobody is tied: the sum of the ring in its order, plus the nearest, plus the farthest.
  for (const std::uint64_t seed : {1, 2}) {
    const TriangleMesh before =
        numbered_at_random(test::with_noise(make_sphere(1, 4), 0.02, seed), seed);
    const test::PlainRings rings = test::plain_rings(before, BoundaryRule::fixed);
    std::vector<Vec3d> expected = test::plain_positions(before);
    for (int pass = 0; pass < 6; ++pass) {
      const std::vector<Vec3d> now = expected;
      for (std::size_t v = 0; v < now.size(); ++v) {
        const auto distance = [&](std::uint32_t w) { return squared_norm(now[w] - now[v]); };
        const auto nearer = [&](auto a, auto b) { return distance(a) < distance(b); };
        Vec3d sum;
        for (const std::uint32_t w : rings[v]) sum += now[w];
        sum += now[*std::min_element(rings[v].begin(), rings[v].end(), nearer)];
        sum += now[*std::max_element(rings[v].begin(), rings[v].end(), nearer)];
        expected[v] = sum / (2 + static_cast<double>(rings[v].size()));
      }
    }
    TriangleMesh mesh = before;
    ASSERT_TRUE(smooth_nearest_farthest(mesh, {.iterations = 6}));
    std::size_t others = 0;
    for (std::size_t v = 0; v < expected.size(); ++v) {
      others += mesh.positions[v] != Vec3f(expected[v]);
    }
    // Float coordinates leave some rings in which two are as near as can be told.
    EXPECT_LE(others, expected.size() / 50);
  }
}

}  // namespace
}  // namespace burnish
