#include "burnish/points/merge_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "burnish/points/cloud_measurements.h"
#include "burnish/points/surfels.h"

namespace burnish {
namespace {

constexpr int kRounds = 2;              // of mean shift, after the first
constexpr int kSampleRounds = 2;        // of that which the poses are estimated with
constexpr std::size_t kSampleStep = 4;  // rows and columns that the estimate of the poses skips

/// How far poses are off: what the scatter of a sample of measurements about the surface that all
/// of them make has beyond their noise, m.
Result<double> estimate_registration(CloudMeasurements& measurements, double spacing, double sigma,
                                     const Context& context) {
  if (measurements.lists() < 2) return 0.0;
  const double coarse = spacing * static_cast<double>(kSampleStep);
  measurements.thin(kSampleStep);
  measurements.weigh({spacing, coarse / 2, 1});  // poses so far off that windows are sure to see it
  const auto cells = average_in_cells(measurements, coarse / 2, std::max(sigma, spacing) / 4,
                                      measurements.typical(), context.part(0, 0.5));
  measurements.thin(1);
  if (!cells) return cells.error();
  Surfels surfels = every_cell(*cells, coarse);
  if (!slide(*cells, kSampleRounds, surfels, context.part(0.5, 1))) return cancelled();
  std::vector<double> moves;
  for (std::size_t i = 0; i < cells->cells.size(); ++i) {
    const Surfel& surfel = surfels.points[i];
    const Vec3d move = Vec3d(cells->cells[i].position) - Vec3d(surfel.position);
    moves.push_back(std::abs(dot(move, Vec3d(surfel.normal))));
  }
  if (moves.empty()) return 0.0;
  // A few frames that are far off make a second layer, so the tail of the scatter counts, not its
  // middle: 90 % of a normal distribution lie within 1.645 standard deviations.
  const auto place = moves.begin() + static_cast<std::ptrdiff_t>(moves.size() * 9 / 10);
  std::nth_element(moves.begin(), place, moves.end());
  const double scatter = *place / 1.645;
  return std::sqrt(std::max(0.0, scatter * scatter - sigma * sigma));
}

/// What the measurements of each surfel's patch add up to.
struct Patches {
  std::vector<double> information;
  std::vector<std::uint32_t> observations;
  std::vector<Precision> precision;  ///< empty where measurements have none

  Patches(const SurfaceCells& cells, const std::vector<std::uint32_t>& owners, std::size_t count)
      : information(count), observations(count), precision(cells.precisions.empty() ? 0 : count) {
    for (std::size_t i = 0; i < owners.size(); ++i) {
      if (owners[i] == kNoSurfel) continue;
      information[owners[i]] += cells.cells[i].information;
      observations[owners[i]] += cells.cells[i].count;
      if (precision.empty()) continue;
      for (std::size_t k = 0; k < 6; ++k) precision[owners[i]][k] += cells.precisions[i][k];
    }
  }
};

/// The cloud of the surfels that enough was observed of.
PointCloud cloud_of(const Surfels& surfels, const Patches& patches,
                    const std::vector<std::uint8_t>& is_sparse, bool has_sigma,
                    std::uint32_t min_observations) {
  PointCloud cloud;
  for (std::size_t i = 0; i < surfels.points.size(); ++i) {
    if (is_sparse[i] || patches.observations[i] < min_observations) continue;
    cloud.positions.push_back(surfels.points[i].position);
    cloud.attributes.normals.push_back(surfels.points[i].normal);
    cloud.attributes.observations.push_back(patches.observations[i]);
    if (!has_sigma) continue;
    cloud.attributes.sigma.push_back(static_cast<float>(1 / std::sqrt(patches.information[i])));
    if (patches.precision.empty()) continue;
    cloud.attributes.noise.push_back(noise_within(patches.precision[i], surfels.points[i].normal));
  }
  cloud.attributes.origin.assign(cloud.positions.size(), Origin::seen);
  return cloud;
}

Result<void> check_inputs(std::span<const PointCloud> clouds) {
  if (clouds.empty()) return Error{ErrorCode::invalid_argument, "no cloud to merge", {}};
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    const std::string where = fmt::format("cloud {}", i);
    if (auto sound = check(clouds[i]); !sound) {
      return Error{sound.error().code, sound.error().message, where};
    }
    if (clouds[i].attributes.normals.size() != clouds[i].positions.size()) {
      return Error{ErrorCode::bad_geometry, "points have no normals, which merging needs", where};
    }
  }
  return {};
}

}  // namespace

const Schema<MergeCellsParams>& MergeCellsParams::schema() {
  using P = MergeCellsParams;
  static const auto schema =
      Schema<P>()
          .real("spacing", &P::spacing, at_least(0),
                "distance between neighbouring points; 0: twice that of the rays", Quantity::length)
          .real("registration", &P::registration, at_least(0),
                "standard deviation of the poses; 0: estimated from the clouds", Quantity::length)
          .real("correlation", &P::correlation, between(0, 1),
                "of the noise of neighbouring pixels of one image")
          .integer("min_observations", &P::min_observations, between(1, 1000000),
                   "points that fewer measurements support are left out");
  return schema;
}

Result<Merging> merge_cells(std::span<const PointCloud> clouds, const MergeCellsParams& params,
                            const Context& context) {
  if (auto valid = MergeCellsParams::schema().check(params); !valid) return valid.error();
  if (auto sound = check_inputs(clouds); !sound) return sound.error();

  CloudMeasurements measurements(clouds);
  Merging merging;
  merging.report.clouds = clouds.size();
  merging.report.points_in = measurements.points();
  merging.cloud.frame = clouds[0].frame;
  const double spacing = params.spacing > 0 ? params.spacing : 2 * measurements.typical_footprint();
  const double sigma = measurements.typical_sigma();
  merging.report.spacing = spacing;
  if (!(spacing > 0)) {  // no points, or all in one place
    context.progress(1);
    return merging;
  }

  double registration = params.registration;
  if (registration == 0) {
    const auto found = estimate_registration(measurements, spacing, sigma, context.part(0, 0.1));
    if (!found) return found.error();
    registration = *found;
  }
  measurements.weigh({spacing, registration, params.correlation});
  const double along = std::max(spacing / 2, measurements.deviation(sigma));
  const auto cells = average_in_cells(measurements, spacing / 2, along, measurements.typical(),
                                      context.part(0.1, 0.4));
  if (!cells) return cells.error();

  Surfels surfels = seed_surfels(*cells, spacing);
  if (!slide(*cells, 1, surfels, context.part(0.4, 0.5))) return cancelled();
  if (measurements.has_sigma()) grow(surfels);
  std::vector<std::uint32_t> owners;
  if (!thin_loosely(surfels, context.part(0.5, 0.6)) ||
      !slide(*cells, kRounds, surfels, context.part(0.6, 0.8)) ||
      !thin(surfels, context.part(0.8, 0.9)) ||
      !find_owners(*cells, surfels, owners, context.part(0.9, 0.98))) {
    return cancelled();
  }
  const Patches patches(*cells, owners, surfels.points.size());
  std::vector<std::uint8_t> is_sparse;
  if (!find_sparse(surfels, patches.observations, is_sparse, context.part(0.98, 1))) {
    return cancelled();
  }
  merging.cloud = cloud_of(surfels, patches, is_sparse, measurements.has_sigma(),
                           static_cast<std::uint32_t>(params.min_observations));
  merging.cloud.frame = clouds[0].frame;
  merging.report.points_out = merging.cloud.positions.size();
  return merging;
}

}  // namespace burnish
