#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <benchmark/benchmark.h>

#include <cmath>

#include "burnish/base/random.h"
#include "burnish/triangulation/delaunay.h"
#include "burnish/triangulation/planar_delaunay.h"
#include "burnish/triangulation/plane_order.h"

// The Delaunay triangulation of points of the plane, ours and CGAL's, each with its own sorting, on
// one thread; ours lists the triangles too. And the whole operation on a wavy sheet of points. The
// first argument is the number of points, the second what they are like: 0 random, 1 a lattice in
// steps of a tenth, rounded, 2 in clusters.
namespace burnish {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

std::vector<Vec2d> points_of(const benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  const double side = std::ceil(std::sqrt(static_cast<double>(count)));
  Random random(1);
  std::vector<Vec2d> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.uniform(), y = random.uniform();
    if (state.range(1) == 0) {
      points.push_back({x, y});
    } else if (state.range(1) == 1) {
      const double row = std::floor(static_cast<double>(i) / side);
      points.push_back({0.1 * (static_cast<double>(i) - row * side), 0.1 * row});
    } else {
      points.push_back(
          {std::floor(9 * x) + 1e-3 * random.normal(), std::floor(9 * y) + 1e-3 * random.normal()});
    }
  }
  return points;
}

Context one_thread() {
  Context context;
  context.threads = 1;
  return context;
}

void delaunay_of_points(benchmark::State& state) {
  const std::vector<Vec2d> points = points_of(state);
  std::vector<Triangle> triangles;
  for (auto _ : state) {
    const std::vector<Keyed> order = order_in_plane(points);
    if (!planar_delaunay(points, order, one_thread(), triangles)) state.SkipWithError("failed");
  }
  state.counters["triangles"] = static_cast<double>(triangles.size());
  state.SetItemsProcessed(state.range(0) * state.iterations());
}

void delaunay_of_points_cgal(benchmark::State& state) {
  std::vector<Kernel::Point_2> points;
  for (const Vec2d& p : points_of(state)) points.emplace_back(p.x, p.y);
  std::size_t triangles = 0;
  for (auto _ : state) {
    const CGAL::Delaunay_triangulation_2<Kernel> delaunay(points.begin(), points.end());
    triangles = delaunay.number_of_faces();
  }
  state.counters["triangles"] = static_cast<double>(triangles);
  state.SetItemsProcessed(state.range(0) * state.iterations());
}

void triangulate_sheet(benchmark::State& state) {
  PointCloud cloud;
  for (const Vec2d& p : points_of(state)) {
    cloud.positions.push_back(Vec3f(Vec3d{p.x, p.y, .1 * std::sin(5 * p.x) * std::cos(4 * p.y)}));
  }
  for (auto _ : state) {
    if (!triangulate_delaunay(cloud, {}, one_thread())) state.SkipWithError("failed");
  }
  state.SetItemsProcessed(state.range(0) * state.iterations());
}

void sizes(benchmark::internal::Benchmark* row) {
  row->ArgsProduct({{100000, 1000000}, {0, 1, 2}})->Unit(benchmark::kMillisecond);
}
BENCHMARK(delaunay_of_points)->Apply(sizes);
BENCHMARK(delaunay_of_points_cgal)->Apply(sizes);
BENCHMARK(triangulate_sheet)->Apply(sizes);

}  // namespace
}  // namespace burnish
