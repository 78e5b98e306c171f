#include <benchmark/benchmark.h>

#include <nanoflann.hpp>

#include "burnish/base/random.h"
#include "burnish/measure/surface_samples.h"
#include "burnish/shapes/shapes.h"
#include "burnish/spatial/neighbour_grid.h"

// The nearest neighbours of each of a million points on a surface, one thread: the cells of burnish
// against nanoflann's tree. The first argument is the number of neighbours (0: building alone), the
// second says whether the points come in the order of a scan (0) or in a random one (1).
namespace burnish {
namespace {

constexpr std::size_t kPoints = 1000000;

std::vector<Vec3f> points_on_a_teapot(bool shuffled) {
  std::vector<Vec3f> points;
  for (const SurfaceSample& sample : surface_samples(*make_shape("teapot"), kPoints)) {
    points.push_back(Vec3f(sample.point));
  }
  if (!shuffled) return points;
  Random random(1);
  for (std::size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[random.below(i)]);
  return points;
}

void neighbour_grid(benchmark::State& state) {
  const std::vector<Vec3f> points = points_on_a_teapot(state.range(1) == 1);
  const auto count = static_cast<std::size_t>(state.range(0));
  std::vector<Neighbour> found;
  for (auto _ : state) {
    const NeighbourGrid grid(points);
    for (std::size_t i = 0; count > 0 && i < points.size(); ++i) {
      grid.nearest(points[i], count, found);
      benchmark::DoNotOptimize(found.data());
    }
  }
}

/// How nanoflann reads points.
struct Points {
  const std::vector<Vec3f>& points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][axis]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

void nanoflann_tree(benchmark::State& state) {
  using Distance = nanoflann::L2_Simple_Adaptor<float, Points>;
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<Distance, Points, 3, std::uint32_t>;
  const std::vector<Vec3f> points = points_on_a_teapot(state.range(1) == 1);
  const auto count = static_cast<std::size_t>(state.range(0));
  std::vector<std::uint32_t> found(count + 1);
  std::vector<float> squared(count + 1);
  const Points reader{points};
  for (auto _ : state) {
    const Tree tree(3, reader);
    for (std::size_t i = 0; count > 0 && i < points.size(); ++i) {
      tree.knnSearch(&points[i].x, count, found.data(), squared.data());
      benchmark::DoNotOptimize(found.data());
    }
  }
}

void arguments(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgsProduct({{0, 8, 16}, {0, 1}})
      ->ArgNames({"k", "shuffled"})
      ->Unit(benchmark::kMillisecond);
}
BENCHMARK(neighbour_grid)->Apply(arguments);
BENCHMARK(nanoflann_tree)->Apply(arguments);

}  // namespace
}  // namespace burnish
