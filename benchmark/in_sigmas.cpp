#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "burnish/base/parallel.h"
#include "burnish/io/geometry_file.h"
#include "burnish/measure/surface_samples.h"
#include "burnish/spatial/closest_point.h"

// burnish_benchmark_in_sigmas ORIGINAL RESULT SAMPLES: how far points spread evenly over each of
// the two surfaces are from the other, in units of the original's sigma there, and in mm.
namespace burnish {
namespace {

TriangleMesh required(const char* path) {
  Result<TriangleMesh> mesh = read_mesh(path);
  if (mesh) return *std::move(mesh);
  std::fprintf(stderr, "%s: %s\n", path, mesh.error().message.c_str());
  std::exit(1);
}

/// Sigma at a point of triangle t, weighted by the areas of the triangles to the other corners.
double sigma_at(const TriangleMesh& mesh, std::uint32_t t, const Vec3d& point) {
  const Triangle& corners = mesh.triangles[t];
  double sum = 0, weights = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d a(mesh.positions[corners[(i + 1) % 3]]), b(mesh.positions[corners[(i + 2) % 3]]);
    const double weight = norm(cross(a - point, b - point)) + 1e-30;
    sum += weight * mesh.attributes.sigma[corners[i]];
    weights += weight;
  }
  return sum / weights;
}

struct Far {
  double metres, sigmas;
};

void print(const char* title, std::vector<Far> all) {
  const auto line = [&](const char* unit, auto value) {
    std::vector<double> values;
    double squares = 0;
    for (const Far& far : all) {
      values.push_back(value(far));
      squares += values.back() * values.back();
    }
    std::sort(values.begin(), values.end());
    const auto count = static_cast<double>(values.size());
    const auto rank = [&](double share) {
      return values[static_cast<std::size_t>(share * (count - 1))];
    };
    std::printf("%s, %s: RMS %.3f, median %.3f, 95 %% below %.3f, 99.9 %% below %.3f, max %.3f\n",
                title, unit, std::sqrt(squares / count), rank(0.5), rank(0.95), rank(0.999),
                values.back());
  };
  line("sigmas", [](const Far& far) { return far.sigmas; });
  line("mm", [](const Far& far) { return 1000 * far.metres; });
}

}  // namespace
}  // namespace burnish

int main(int argc, char** argv) {
  using namespace burnish;
  if (argc != 4) return 2;
  const TriangleMesh original = required(argv[1]), result = required(argv[2]);
  if (original.attributes.sigma.empty()) return 1;
  const ClosestPoint to_original(original), to_result(result);
  const auto measure = [&](const char* title, const TriangleMesh& from, auto far) {
    const auto samples = surface_samples(from, std::stoul(argv[3]));
    std::vector<Far> all(samples.size());
    const bool done = parallel_for({}, samples.size(), [&](IndexRange range) {
      for (std::size_t i = range.begin; i < range.end; ++i) all[i] = far(samples[i]);
    });
    if (!done) std::exit(1);
    print(title, std::move(all));
  };
  measure("from the original", original, [&](const SurfaceSample& s) {
    const double distance = to_result(s.point).distance;
    return Far{distance, distance / sigma_at(original, s.triangle, s.point)};
  });
  measure("from the result", result, [&](const SurfaceSample& s) {
    const auto found = to_original(s.point);
    return Far{found.distance, found.distance / sigma_at(original, found.triangle, found.point)};
  });
}
