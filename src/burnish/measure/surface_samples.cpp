#include "burnish/measure/surface_samples.h"

#include <algorithm>
#include <string>

#include "burnish/base/random.h"

namespace burnish {
namespace {

/// The sums of twice the areas up to and including each triangle.
std::vector<double> area_sums(const TriangleMesh& mesh) {
  std::vector<double> sums(mesh.triangles.size());
  double sum = 0;
  for (std::size_t t = 0; t < sums.size(); ++t) sums[t] = sum += norm(area_vector(mesh, t));
  return sums;
}

}  // namespace

std::vector<SurfaceSample> surface_samples(const TriangleMesh& mesh, std::size_t count,
                                           std::uint64_t seed) {
  const std::vector<double> sums = area_sums(mesh);
  std::vector<SurfaceSample> samples(count);
  for (std::size_t i = 0; i < count; ++i) {
    Random random(seed, i);
    const double at = (static_cast<double>(i) + random.uniform()) / static_cast<double>(count);
    const auto found = std::upper_bound(sums.begin(), sums.end() - 1, at * sums.back());
    const auto t = static_cast<std::uint32_t>(found - sums.begin());
    double u = random.uniform(), v = random.uniform();
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const auto [a, b, c] = mesh.triangles[t];
    const Vec3d p(mesh.positions[a]);
    samples[i] = {p + u * (Vec3d(mesh.positions[b]) - p) + v * (Vec3d(mesh.positions[c]) - p), t};
  }
  return samples;
}

double surface_area(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) sum += norm(area_vector(mesh, t));
  return sum / 2;
}

Result<void> check_surface(const TriangleMesh& mesh, std::string_view name) {
  if (auto sound = check(mesh); !sound) {
    return Error{sound.error().code, sound.error().message, std::string(name)};
  }
  if (!(surface_area(mesh) > 0)) {
    return Error{ErrorCode::bad_geometry, "a surface with an area expected", std::string(name)};
  }
  return {};
}

}  // namespace burnish
