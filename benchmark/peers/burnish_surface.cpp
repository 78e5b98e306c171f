#include <cstdio>
#include <cstdlib>

#include "burnish/catalogue/operations.h"
#include "burnish/io/geometry_file.h"
#include "stopwatch.h"

// surface_burnish IN OUT METHOD THREADS: as the peers do, with a method of burnish's catalogue.
int main(int argc, char** argv) {
  using namespace burnish;
  if (argc != 5) return 2;
  const auto fail = [](const Error& error) {
    std::fprintf(stderr, "%s %s\n", error.where.c_str(), error.message.c_str());
    return 1;
  };
  const Result<PointCloud> cloud = read_cloud(argv[1]);
  if (!cloud) return fail(cloud.error());
  const Result<Method> method = parse_method(argv[3]);
  if (!method) return fail(method.error());
  const auto operation = find_triangulate(method->name);
  if (!operation) return fail(operation.error());
  Context context;
  context.threads = std::atoi(argv[4]);
  const Stopwatch stopwatch;
  const auto made = (*operation)->run(*cloud, method->settings, context);
  stopwatch.print();
  if (!made) return fail(made.error());
  if (auto written = write_mesh(argv[2], made->value); !written) return fail(written.error());
}
