#include <chrono>
#include <cstdio>
#include <string>

#include "burnish/catalogue/operations.h"
#include "burnish/io/geometry_file.h"
#include "burnish/measure/denoising_error.h"

// burnish_benchmark_denoise NOISY TRUTH [METHOD...]: a line of JSON for the noisy mesh and for what
// each method makes of it, on one thread: its seconds, and what differs from the truth, vertex for
// vertex where the triangles are those of the truth, else by nearest triangles.
namespace burnish {
namespace {

int fail(const Error& error) {
  std::fprintf(stderr, "%s %s\n", error.where.c_str(), error.message.c_str());
  return 1;
}

/// Seconds, or why the method failed.
Result<double> smooth(const std::string& text, TriangleMesh& mesh, const Context& context) {
  const Result<Method> method = parse_method(text);
  if (!method) return method.error();
  const auto operation = find_smooth(method->name);
  if (!operation) return operation.error();
  const auto start = std::chrono::steady_clock::now();
  if (auto done = (*operation)->run(mesh, method->settings, context); !done) return done.error();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Result<void> print(const TriangleMesh& mesh, const TriangleMesh& truth, double seconds,
                   const Context& context) {
  const auto error = correspond(mesh, truth) ? compare_denoised(mesh, truth, context)
                                             : compare_to_nearest(mesh, truth, context);
  if (!error) return error.error();
  std::printf("{\"seconds\": %.6g, \"flipped_share\": %.9g", seconds, error->flipped_share());
  for (const Fact& fact : error->facts())
    std::printf(", \"%s\": %.9g", fact.key.c_str(), fact.value);
  std::printf("}\n");
  return {};
}

}  // namespace
}  // namespace burnish

int main(int argc, char** argv) {
  using namespace burnish;
  if (argc < 3) return 2;
  const Result<TriangleMesh> noisy = read_mesh(argv[1]), truth = read_mesh(argv[2]);
  if (!noisy) return fail(noisy.error());
  if (!truth) return fail(truth.error());
  Context context;
  context.threads = 1;
  if (auto printed = print(*noisy, *truth, 0, context); !printed) return fail(printed.error());
  for (int i = 3; i < argc; ++i) {
    TriangleMesh mesh = *noisy;
    const Result<double> seconds = smooth(argv[i], mesh, context);
    if (!seconds) return fail(seconds.error());
    if (auto printed = print(mesh, *truth, *seconds, context); !printed)
      return fail(printed.error());
  }
}
