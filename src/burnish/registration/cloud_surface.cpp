#include "burnish/registration/cloud_surface.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>

#include "burnish/base/parallel.h"
#include "burnish/base/random.h"
#include "burnish/points/estimate_normals.h"
#include "burnish/points/organized_normals.h"
#include "burnish/registration/evidence.h"

namespace burnish {
namespace {

constexpr std::size_t kNeighbours = 12;
constexpr float kRoughness = 0.1f;  // of the spacing

/// How the neighbours of a point lie: how far they are off, and by how much they leave their plane.
struct Neighbourhood {
  double spacing = 0, scatter = 0;

  Neighbourhood(const std::vector<Vec3f>& positions, std::span<const std::uint32_t> which) {
    Vec3d mean;
    for (const std::uint32_t i : which) mean += Vec3d(positions[i]);
    mean = mean / static_cast<double>(which.size());
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    for (const std::uint32_t i : which) {
      const Vec3d d = Vec3d(positions[i]) - mean;
      const Eigen::Vector3d e(d.x, d.y, d.z);
      moments += e * e.transpose();
    }
    const double n = static_cast<double>(which.size());
    const Eigen::Vector3d values =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments, Eigen::EigenvaluesOnly)
            .eigenvalues();
    scatter = n > 3 ? std::sqrt(std::max(0.0, values[0]) / (n - 3)) : 0;
    // n points over a disc of variance v per axis: area 4 pi v, of which each has a square.
    spacing = std::sqrt(4 * std::numbers::pi * std::max(0.0, values[1] + values[2]) / (2 * n * n));
  }
};

void find_extent(CloudSurface& surface) {
  Vec3d sum;
  double squares = 0;
  for (const Vec3f& p : surface.positions) {
    sum += Vec3d(p);
    squares += squared_norm(Vec3d(p));
  }
  const double n = static_cast<double>(surface.size());
  surface.middle = sum / n;
  surface.radius = std::sqrt(std::max(0.0, squares / n - squared_norm(surface.middle)));
}

}  // namespace

Result<CloudSurface> cloud_surface(const PointCloud& given, double distortion,
                                   const Context& context) {
  if (auto sound = check(given); !sound) return sound.error();
  PointCloud cloud = given;
  const bool seen_from_a_place = cloud.viewpoint || cloud.grid;
  const bool has_normals = !cloud.attributes.normals.empty();
  if (!has_normals) {
    const auto estimated = estimate_normals(cloud, {}, context.part(0, 0.6));
    if (!estimated) return estimated.error();
  }
  CloudSurface surface;
  surface.origin = cloud.frame.origin;
  surface.oriented = seen_from_a_place || has_normals;
  surface.noise_points = cloud.grid ? shared_noise() : 1;
  std::vector<float> sigma;
  const Vec3d eye = viewpoint_or_origin(cloud);
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    const Vec3f &p = cloud.positions[i], &n = cloud.attributes.normals[i];
    if (!is_finite(p) || !(squared_norm(n) > 0)) continue;
    surface.positions.push_back(p);
    surface.normals.push_back(n);
    if (!cloud.attributes.sigma.empty()) surface.sigma.push_back(cloud.attributes.sigma[i]);
    // distance^2 cos(theta) = distance (ray . n): at the image's rim a little more than z^2 is.
    const Vec3d ray = Vec3d(p) - eye;
    const double bend =
        seen_from_a_place ? distortion * norm(ray) * std::abs(dot(ray, Vec3d(n))) : 0;
    surface.bias.push_back(static_cast<float>(bend));
  }
  if (surface.size() < kNeighbours) {
    return Error{
        ErrorCode::bad_geometry,
        fmt::format("{} points with a normal, at least {} expected", surface.size(), kNeighbours),
        {}};
  }
  find_extent(surface);
  const NeighbourGrid grid(surface.positions);
  NeighbourLists lists;
  if (!grid.nearest_of_all(kNeighbours, context.part(0.6, 0.8), lists)) return cancelled();
  const bool measured = !surface.sigma.empty();
  surface.sigma.resize(surface.size());
  surface.spacing.resize(surface.size());
  const bool complete = parallel_for(context.part(0.8, 1), surface.size(), [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const Neighbourhood around(surface.positions, lists.of(i));
      surface.spacing[i] = static_cast<float>(around.spacing);
      if (!measured) surface.sigma[i] = static_cast<float>(around.scatter);
      surface.bias[i] = std::hypot(surface.bias[i], kRoughness * surface.spacing[i]);
    }
  });
  if (!complete) return cancelled();
  return surface;
}

std::vector<std::uint32_t> sample(std::size_t total, std::size_t count, std::uint64_t seed) {
  std::vector<std::uint32_t> numbers;
  if (total <= count) {
    numbers.resize(total);
    std::iota(numbers.begin(), numbers.end(), 0u);
    return numbers;
  }
  const double share = static_cast<double>(count) / static_cast<double>(total);
  for (std::size_t i = 0; i < total; ++i) {
    if (Random(seed, i).uniform() < share) numbers.push_back(static_cast<std::uint32_t>(i));
  }
  return numbers;
}

}  // namespace burnish
