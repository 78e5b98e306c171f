#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "burnish/catalogue/operations.h"
#include "burnish/io/geometry_file.h"

// surface_burnish IN OUT ROUNDS METHOD THREADS: as the peers do, with a method of burnish's
// catalogue.
int main(int argc, char** argv) {
  using namespace burnish;
  if (argc != 6) return 2;
  const auto fail = [](const Error& error) {
    std::fprintf(stderr, "%s %s\n", error.where.c_str(), error.message.c_str());
    return 1;
  };
  const Result<PointCloud> cloud = read_cloud(argv[1]);
  if (!cloud) return fail(cloud.error());
  const Result<Method> method = parse_method(argv[4]);
  if (!method) return fail(method.error());
  const auto operation = find_triangulate(method->name);
  if (!operation) return fail(operation.error());
  Context context;
  context.threads = std::atoi(argv[5]);
  const int rounds = std::atoi(argv[3]);
  for (int round = 0; round < rounds; ++round) {
    const auto start = std::chrono::steady_clock::now();
    const auto made = (*operation)->run(*cloud, method->settings, context);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    if (!made) return fail(made.error());
    std::printf("%.6f%c", seconds.count(), round + 1 < rounds ? ' ' : '\n');
    if (round + 1 < rounds) continue;
    if (auto written = write_mesh(argv[2], made->value); !written) return fail(written.error());
  }
}
