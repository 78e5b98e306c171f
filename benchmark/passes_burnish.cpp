#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "burnish/base/large_vector.h"
#include "burnish/base/parallel.h"
#include "burnish/smoothing/nearest_farthest.h"
#include "burnish/smoothing/one_ring_mean.h"
#include "burnish/smoothing/ring_mesh.h"
#include "peers/passes_peer.h"

// passes_burnish MESH mean|equation1 THREADS    as the peers do (peers/passes_peer.h), and then the
//                                               seconds of one more pass
// passes_burnish bandwidth THREADS              GB/s of copying memory
namespace {

using namespace burnish;

Context with_threads(const char* text) {
  Context context;
  context.threads = std::atoi(text);
  return context;
}

void smooth(TriangleMesh mesh, bool equation1, int passes, const Context& context) {
  const bool done = equation1
                        ? smooth_nearest_farthest(mesh, {.iterations = passes}, context).has_value()
                        : smooth_one_ring_mean(mesh, {.iterations = passes}, context).has_value();
  if (!done) std::exit(1);
}

int time_passes(char** argv, bool equation1) {
  const PlainMesh plain = read_plain_mesh(argv[1]);
  TriangleMesh mesh;
  for (const auto& [x, y, z] : plain.positions) mesh.positions.push_back({x, y, z});
  mesh.triangles = plain.triangles;
  const Context context = with_threads(argv[3]);
  const Stopwatch first;
  (void)smoothing_rings(mesh, BoundaryRule::fixed);
  const Seconds adjacency = first.seconds();
  const Stopwatch second;
  smooth(mesh, equation1, kPasses, context);
  const Seconds ten = second.seconds();
  const Stopwatch third;
  smooth(mesh, equation1, 5 * kPasses, context);
  const Seconds more = third.seconds() - ten;
  adjacency.print();
  (ten - adjacency).print();
  Seconds{more.wall / (4 * kPasses), more.processor / (4 * kPasses)}.print();
  return 0;
}

/// The best of some copies between arrays that no cache holds; read and written bytes both count.
int print_bandwidth(const Context& context) {
  constexpr std::size_t kCount = std::size_t{1} << 25;
  LargeVector<double> from(kCount, 1.), to(kCount, 0.);
  double best = 0;
  for (int round = 0; round < 10; ++round) {
    const Stopwatch watch;
    const bool done = parallel_for(
        context, kCount,
        [&](IndexRange range) {
          for (std::size_t i = range.begin; i < range.end; ++i) to[i] = 1.5 * from[i];
        },
        kCount / 64);
    if (!done) return 1;
    best = std::max(best, 2 * sizeof(double) * kCount / watch.seconds().wall / 1e9);
  }
  std::printf("%.2f\n", best);
  return to[kCount / 2] == 1.5 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3 && std::string(argv[1]) == "bandwidth") {
    return print_bandwidth(with_threads(argv[2]));
  }
  if (argc != 4) return 2;
  return time_passes(argv, wants_equation1(argc, argv));
}
