#include "burnish/points/cloud_measurements.h"

#include <algorithm>
#include <cmath>

#include "burnish/points/organized_normals.h"
#include "burnish/spatial/neighbour_grid.h"

namespace burnish {
namespace {

constexpr std::size_t kSampled = 61;      // every so-manieth pixel stands for the rest in a median
constexpr int kFrayed = 2;                // pixels along outlines that tell less
constexpr double kFrayedTrust = 1. / 16;  // namely as if their sigma were four times as large
constexpr double kLeastSigma = 1e-3;      // of the spacing; weights stay finite where sigma is 0

double median(std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Which points of a cloud stand for all in a median. Where there is no grid, the order of points
/// means nothing and nothing may depend on it.
std::size_t sample_step(const PointCloud& cloud) {
  return cloud.grid ? kSampled : 1;
}

/// The distance from every point to its nearest neighbour that is not in its place.
void add_neighbour_distances(const PointCloud& cloud, std::vector<double>& distances) {
  const NeighbourGrid grid(cloud.positions);
  std::vector<Neighbour> found;
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    grid.nearest(cloud.positions[i], 4, found);
    for (const Neighbour& neighbour : found) {
      if (neighbour.squared_distance > 0) {
        distances.push_back(std::sqrt(neighbour.squared_distance));
        break;
      }
    }
  }
}

/// Which pixels lie within kFrayed pixels of an outline: of missing pixels or of something farther.
/// What they saw may lie beside the surface by as much as the image is unsharp.
std::vector<std::uint8_t> find_outlines(const ProjectiveGrid& grid, std::span<const float> noise) {
  const std::size_t width = grid.size.width, count = grid.pixels.size();
  const auto beyond = [&](std::size_t i, std::size_t j) {
    const auto &a = grid.pixels[i], &b = grid.pixels[j];
    return !(b.w > 0) || (b.w < a.w && !same_surface(a, b, std::max(noise[i], noise[j])));
  };
  std::vector<std::uint8_t> outlined(count);
  for (int ring = 0; ring < kFrayed; ++ring) {
    const std::vector<std::uint8_t> before = outlined;
    for (std::size_t i = 0; i < count; ++i) {
      if (before[i] || !(grid.pixels[i].w > 0)) continue;
      const auto ends_at = [&](std::size_t j) {
        return ring == 0 ? beyond(i, j) : before[j] && !beyond(j, i);
      };
      const std::size_t column = i % width;
      outlined[i] = (column > 0 && ends_at(i - 1)) || (column + 1 < width && ends_at(i + 1)) ||
                    (i >= width && ends_at(i - width)) || (i + width < count && ends_at(i + width));
    }
  }
  return outlined;
}

}  // namespace

CloudMeasurements::CloudMeasurements(std::span<const PointCloud> clouds) : clouds_(clouds) {
  for (const PointCloud& cloud : clouds) {
    View view{cloud.frame.origin - clouds[0].frame.origin, viewpoint_or_origin(cloud), 0, {}};
    if (cloud.grid) {
      const ProjectiveGrid grid = project_grid(cloud);
      view.pitch = pixel_pitch(grid);
      view.outlined = find_outlines(grid, depth_noise(grid, cloud.attributes.sigma));
    }
    views_.push_back(std::move(view));
    has_sigma_ = has_sigma_ && (cloud.positions.empty() || !cloud.attributes.sigma.empty());
    has_noise_ = has_noise_ && (cloud.positions.empty() || !cloud.attributes.noise.empty());
  }
}

double CloudMeasurements::typical_footprint() const {
  std::vector<double> footprints;
  for (std::size_t list = 0; list < clouds_.size(); ++list) {
    const PointCloud& cloud = clouds_[list];
    if (!cloud.grid) {
      add_neighbour_distances(cloud, footprints);
      continue;
    }
    for (std::size_t i = 0; i < cloud.positions.size(); i += kSampled) {
      if (!is_finite(cloud.positions[i])) continue;
      footprints.push_back(views_[list].pitch * norm(Vec3d(cloud.positions[i]) - views_[list].eye));
    }
  }
  return median(footprints);
}

double CloudMeasurements::typical_sigma() const {
  if (!has_sigma_) return 0;
  std::vector<double> sigmas;
  for (const PointCloud& cloud : clouds_) {
    for (std::size_t i = 0; i < cloud.positions.size(); i += sample_step(cloud)) {
      if (is_finite(cloud.positions[i])) sigmas.push_back(cloud.attributes.sigma[i]);
    }
  }
  return median(sigmas);
}

std::size_t CloudMeasurements::points() const {
  std::size_t count = 0;
  for (const PointCloud& cloud : clouds_) {
    count += static_cast<std::size_t>(
        std::count_if(cloud.positions.begin(), cloud.positions.end(), is_finite<float>));
  }
  return count;
}

double CloudMeasurements::deviation(double sigma) const {
  return std::hypot(std::max(sigma, kLeastSigma * weighing_.spacing), weighing_.registration);
}

Measurement CloudMeasurements::typical() const {
  const double sigma = std::max(typical_sigma(), kLeastSigma * weighing_.spacing);
  Measurement m;
  m.weight = 1 / (deviation(sigma) * deviation(sigma));
  m.information = 1 / (sigma * sigma);
  return m;
}

bool CloudMeasurements::counts(std::size_t list, std::size_t i) const {
  const PointCloud& cloud = clouds_[list];
  if (!is_finite(cloud.positions[i]) || cloud.attributes.normals[i] == Vec3f{}) return false;
  if (!cloud.grid) return true;
  return i % cloud.grid->width % step_ == 0 && i / cloud.grid->width % step_ == 0;
}

double CloudMeasurements::sigma(std::size_t list, std::size_t i) const {
  const double given = has_sigma_ ? double{clouds_[list].attributes.sigma[i]} : 0.0;
  return std::max(given, kLeastSigma * weighing_.spacing);
}

Measurement CloudMeasurements::read(std::size_t list, std::size_t i) const {
  const PointCloud& cloud = clouds_[list];
  const View& view = views_[list];
  const Vec3d p(cloud.positions[i]);
  Measurement m;
  m.position = p + view.shift;
  m.normal = cloud.attributes.normals[i];
  if (!cloud.attributes.observations.empty()) m.count = cloud.attributes.observations[i];
  const double s = sigma(list, i);
  m.weight = 1 / (deviation(s) * deviation(s));
  double share = 1;  // of its information that no other pixel of the patch tells too
  if (view.pitch > 0) {
    const Vec3d ray = p - view.eye;
    const double facing = std::abs(dot(normalized(ray), Vec3d(m.normal)));
    const double footprint = view.pitch * norm(ray);
    const double in_patch =
        weighing_.spacing * weighing_.spacing * facing / (footprint * footprint);
    share = 1 / (1 + std::max(0.0, in_patch - 1) * weighing_.correlation);
    if (view.outlined[i]) share *= kFrayedTrust;
  }
  m.information = share / (s * s);
  if (has_noise_) {
    m.precision = precision_of(cloud.attributes.noise[i], kLeastSigma * weighing_.spacing);
    for (double& entry : m.precision) entry *= share;
  }
  return m;
}

}  // namespace burnish
