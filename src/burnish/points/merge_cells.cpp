#include "burnish/points/merge_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "burnish/base/parallel.h"
#include "burnish/points/cloud_measurements.h"
#include "burnish/points/surface_columns.h"

namespace burnish {
namespace {

constexpr double kAgree = 0.5;     // cosine up to which normals belong to one surface
constexpr double kAlong = 0.3;     // least component of a normal in a field that may hold its like
constexpr double kWindow = 1.5;    // radius of the averaging window, spacings
constexpr double kDeep = 3;        // half its depth, standard deviations
constexpr double kSharp = 1. / 3;  // sigma of a point that is fine enough, spacings
constexpr double kWidest = 4;      // largest growth of the spacing
constexpr double kWeak = 1. / 3;   // support of a layer that yields to one beside it
constexpr double kApart = 0.5;     // least distance across creases, spacings
constexpr int kRounds = 3;         // of the mean shift
constexpr std::size_t kSampleStep = 4;  // rows and columns that the estimate of the poses skips
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// A cell's mean on its way to the surface.
struct Surfel {
  Vec3f position, normal;
  float spacing = 0;      ///< wanted around it, m
  float information = 0;  ///< of its window, 1/m^2
};

/// The surfels of the cells and what is common to all of them.
struct Surface {
  const SurfaceColumns& columns;
  double spacing, window_radius;
  std::vector<Surfel> surfels;

  /// Half the depth of the window of cell i.
  double depth(std::size_t i) const {
    const SurfaceColumns::Cell& cell = columns.cells()[i];
    return std::max(kDeep * std::sqrt(static_cast<double>(cell.measured) / cell.weight),
                    spacing / 2);
  }
};

/// Where q lies relative to a surface element at p with normal n: its height above the plane and
/// the square of its distance from p after it slid to the plane along `axis`, in units of the
/// window.
struct Offset {
  double height, squared_reach;

  Offset(const Vec3d& p, const Vec3d& n, const Vec3f& q, std::size_t axis) {
    Vec3d d = Vec3d(q) - p;
    height = dot(d, n);
    d[axis] -= height / n[axis];
    squared_reach = squared_norm(d);
  }
};

bool agree(const Vec3d& n, const Vec3f& m) {
  return dot(n, Vec3d(m)) > kAgree;
}

/// One step of the mean shift of surfel i; see merge_cells.h.
Surfel shifted(const Surface& surface, std::size_t i) {
  const std::vector<SurfaceColumns::Cell>& cells = surface.columns.cells();
  Surfel surfel = surface.surfels[i];
  const Vec3d p(surfel.position), n(surfel.normal);
  const double radius = kWindow * surfel.spacing, depth = surface.depth(i);
  const double per_radius = 1 / (radius * radius), per_depth = 1 / (depth * depth);
  double weight = 0, height = 0, information = 0;
  Vec3d normal;
  surface.columns.visit(p, n, radius, kAlong, [&](std::uint32_t j, std::size_t axis) {
    const SurfaceColumns::Cell& cell = cells[j];
    if (!agree(n, cell.normal)) return;
    const Offset offset(p, n, cell.position, axis);
    const double across = 1 - offset.squared_reach * per_radius;
    const double along = 1 - offset.height * offset.height * per_depth;
    if (across <= 0 || along <= 0) return;
    const double kernel = across * across * along * along;
    weight += kernel * cell.weight;
    height += kernel * cell.weight * offset.height;
    information += kernel * cell.information;
    normal += kernel * cell.weight * Vec3d(cell.normal);
  });
  if (!(weight > 0)) return surfel;
  const std::size_t axis = surface.columns.axis(i);
  if (std::abs(n[axis]) >= kAlong) {
    surfel.position[axis] = static_cast<float>(p[axis] + height / weight / n[axis]);
  }
  surfel.normal = Vec3f(normalized(normal));
  surfel.information = static_cast<float>(information);
  return surfel;
}

/// The spacing at which the measurements around a surfel suffice: sigma falls as 1 / spacing, so
/// sigma / spacing = kSharp at the geometric mean of both.
float sufficient_spacing(const Surfel& surfel, double spacing) {
  if (!(surfel.information > 0)) return static_cast<float>(spacing);
  const double sigma = 1 / std::sqrt(static_cast<double>(surfel.information));
  return static_cast<float>(spacing *
                            std::clamp(std::sqrt(sigma / (kSharp * spacing)), 1., kWidest));
}

/// Slides all surfels to the surface; the first round's windows tell which spacing suffices.
bool slide(Surface& surface, bool grow, const Context& context) {
  std::vector<Surfel> next(surface.surfels.size());
  for (int round = 0; round < kRounds; ++round) {
    const bool complete =
        parallel_for(context.part(static_cast<double>(round) / kRounds, (round + 1.0) / kRounds),
                     next.size(), [&](IndexRange range) {
                       for (std::size_t i = range.begin; i < range.end; ++i) {
                         next[i] = shifted(surface, i);
                         if (round == 0 && grow)
                           next[i].spacing = sufficient_spacing(next[i], surface.spacing);
                       }
                     });
    if (!complete) return false;
    std::swap(surface.surfels, next);
  }
  return true;
}

/// Calls visit(j, offset) for the surfels of the same surface around surfel i.
template <class Visit>
void visit_surfels(const Surface& surface, std::size_t i, double radius, const Visit& visit) {
  const Surfel& surfel = surface.surfels[i];
  const Vec3d p(surfel.position), n(surfel.normal);
  const double depth = surface.depth(i);
  surface.columns.visit(p, n, radius, kAlong, [&](std::uint32_t j, std::size_t axis) {
    const Surfel& other = surface.surfels[j];
    if (!agree(n, other.normal)) return;
    const Offset offset(p, n, other.position, axis);
    if (std::abs(offset.height) <= depth && offset.squared_reach < radius * radius)
      visit(j, offset);
  });
}

/// Per surfel whether a layer with far more support lies above or below it.
bool find_weak(const Surface& surface, const Context& context, std::vector<std::uint8_t>& weak) {
  weak.assign(surface.surfels.size(), 0);
  return parallel_for(context, weak.size(), [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const Surfel& surfel = surface.surfels[i];
      visit_surfels(surface, i, surfel.spacing, [&](std::uint32_t j, const Offset& offset) {
        const bool beside = std::abs(offset.height) * 3 > surfel.spacing;
        weak[i] |= beside && surfel.information < kWeak * surface.surfels[j].information;
      });
    }
  });
}

/// Whether a kept surfel is too near to surfel i: nearer than the spacing on the same surface, or
/// nearer than half of it on any that does not face the other way.
bool crowded(const Surface& surface, std::size_t i, const std::vector<std::uint32_t>& kept_as) {
  const Surfel& surfel = surface.surfels[i];
  bool near = false;
  visit_surfels(surface, i, surfel.spacing,
                [&](std::uint32_t j, const Offset&) { near |= kept_as[j] != kNone; });
  if (near) return true;
  const double apart = kApart * surface.spacing;
  const Vec3d p(surfel.position), n(surfel.normal);
  surface.columns.visit(p, n, apart, -kAgree, [&](std::uint32_t j, std::size_t) {
    const Surfel& other = surface.surfels[j];
    near |= kept_as[j] != kNone && dot(n, Vec3d(other.normal)) > -kAgree &&
            squared_norm(Vec3d(other.position) - p) < apart * apart;
  });
  return near;
}

/// The surfels to keep, one to a patch, and the place of each among them (kNone: not kept).
std::vector<std::uint32_t> thin(const Surface& surface, const std::vector<std::uint8_t>& weak,
                                std::vector<std::uint32_t>& kept_as) {
  std::vector<std::uint32_t> kept;
  kept_as.assign(surface.surfels.size(), kNone);
  for (std::uint32_t i = 0; i < kept_as.size(); ++i) {
    if (weak[i] || crowded(surface, i, kept_as)) continue;
    kept_as[i] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(i);
  }
  return kept;
}

/// For every cell the nearest kept surfel of its surface within a spacing and a half.
bool find_owners(const Surface& surface, const std::vector<std::uint32_t>& kept_as,
                 const Context& context, std::vector<std::uint32_t>& owners) {
  owners.assign(kept_as.size(), kNone);
  return parallel_for(context, owners.size(), [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      double least = std::numeric_limits<double>::infinity();
      visit_surfels(surface, i, 1.5 * surface.surfels[i].spacing,
                    [&](std::uint32_t j, const Offset& offset) {
                      if (kept_as[j] == kNone || offset.squared_reach >= least) return;
                      least = offset.squared_reach;
                      owners[i] = kept_as[j];
                    });
    }
  });
}

PointCloud cloud_of(const Surface& surface, const std::vector<std::uint32_t>& kept,
                    const std::vector<std::uint32_t>& owners, bool has_sigma,
                    int min_observations) {
  std::vector<double> information(kept.size());
  std::vector<std::uint32_t> observations(kept.size());
  for (std::size_t i = 0; i < owners.size(); ++i) {
    if (owners[i] == kNone) continue;
    information[owners[i]] += surface.columns.cells()[i].information;
    observations[owners[i]] += surface.columns.cells()[i].count;
  }
  PointCloud cloud;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    if (observations[k] < static_cast<std::uint32_t>(min_observations)) continue;
    cloud.positions.push_back(surface.surfels[kept[k]].position);
    cloud.attributes.normals.push_back(surface.surfels[kept[k]].normal);
    cloud.attributes.observations.push_back(observations[k]);
    if (has_sigma) {
      cloud.attributes.sigma.push_back(static_cast<float>(1 / std::sqrt(information[k])));
    }
  }
  cloud.attributes.origin.assign(cloud.positions.size(), Origin::seen);
  return cloud;
}

/// Columns of measurements and the surfels that stand for their cells.
Surface surface_of(const SurfaceColumns& columns, double spacing) {
  Surface surface{columns, spacing, kWindow * spacing, {}};
  surface.surfels.reserve(columns.cells().size());
  for (const SurfaceColumns::Cell& cell : columns.cells()) {
    surface.surfels.push_back(
        {cell.position, cell.normal, static_cast<float>(spacing), cell.information});
  }
  return surface;
}

/// How far poses are off: what the scatter of a sample of measurements about the surface that all
/// of them make has beyond their noise, m.
Result<double> estimate_registration(CloudMeasurements& measurements, double spacing, double sigma,
                                     const Context& context) {
  if (measurements.lists() < 2) return 0.0;
  const double step = static_cast<double>(kSampleStep);
  measurements.thin(kSampleStep);
  // Poses off by a spacing at first, so that windows are deep enough to see it.
  measurements.weigh({spacing, 2 * spacing, 1});
  const auto columns = SurfaceColumns::build(measurements, step * spacing / 2, sigma + spacing / 4,
                                             measurements.typical(), context.part(0, 0.5));
  measurements.thin(1);
  if (!columns) return columns.error();
  Surface surface = surface_of(*columns, step * spacing);
  if (!slide(surface, false, context.part(0.5, 1))) return cancelled();
  std::vector<double> moves;
  for (std::size_t i = 0; i < surface.surfels.size(); ++i) {
    const Surfel& surfel = surface.surfels[i];
    const SurfaceColumns::Cell& cell = columns->cells()[i];
    moves.push_back(
        std::abs(dot(Vec3d(cell.position) - Vec3d(surfel.position), Vec3d(surfel.normal))));
  }
  if (moves.empty()) return 0.0;
  const auto middle = moves.begin() + static_cast<std::ptrdiff_t>(moves.size() / 2);
  std::nth_element(moves.begin(), middle, moves.end());
  const double scatter = *middle / 0.6745;
  return std::sqrt(std::max(0.0, scatter * scatter - sigma * sigma));
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
  const auto columns = SurfaceColumns::build(measurements, spacing / 2, along,
                                             measurements.typical(), context.part(0.1, 0.3));
  if (!columns) return columns.error();

  Surface surface = surface_of(*columns, spacing);
  std::vector<std::uint8_t> weak;
  std::vector<std::uint32_t> kept_as, owners;
  if (!slide(surface, measurements.has_sigma(), context.part(0.3, 0.8))) return cancelled();
  if (!find_weak(surface, context.part(0.8, 0.85), weak)) return cancelled();
  const std::vector<std::uint32_t> kept = thin(surface, weak, kept_as);
  if (!find_owners(surface, kept_as, context.part(0.9, 1), owners)) return cancelled();
  const Frame frame = merging.cloud.frame;
  merging.cloud =
      cloud_of(surface, kept, owners, measurements.has_sigma(), params.min_observations);
  merging.cloud.frame = frame;
  merging.report.points_out = merging.cloud.positions.size();
  return merging;
}

}  // namespace burnish
