#include "burnish/points/surfels.h"

#include <algorithm>
#include <cmath>

#include "burnish/base/parallel.h"
#include "burnish/core/gather.h"

namespace burnish {
namespace {

constexpr double kAgree = 0.5;      // least cosine between normals of one surface
constexpr double kAlong = 0.3;      // least component along the axis of a field to look into
constexpr double kUpright = 0.4;    // least component along its column's axis of a surfel's normal
constexpr double kWindow = 1.5;     // radius of a window, spacings
constexpr double kDeep = 3;         // half its depth, standard deviations
constexpr double kSharp = 1. / 3;   // sigma of a point that is fine enough, spacings
constexpr double kWidest = 4;       // largest growth of the spacing
constexpr double kWeak = 1. / 3;    // support of a layer that yields to one beside it
constexpr double kFaint = 1. / 4;   // support of a point that yields to most around it
constexpr double kSparse = 1. / 4;  // observations of a point that yields to most around it
constexpr double kMost = 0.6;       // more than the half that is another side of a sheet
constexpr double kAround = 3;       // how far around is, spacings
constexpr double kApart = 0.5;      // least distance across creases, spacings
constexpr double kLoose = 0.35;     // distance between candidates, spacings

bool agree(const Vec3d& n, const Vec3f& m) {
  return dot(n, Vec3d(m)) > kAgree;
}

/// A piece of surface, and where points lie relative to it.
class Element {
 public:
  struct Offset {
    double height;         ///< above the plane, m
    double squared_reach;  ///< from the centre, after sliding to the plane along a column
  };

  explicit Element(const Surfel& surfel)
      : centre(surfel.position),
        normal(surfel.normal),
        slope_{1 / normal.x, 1 / normal.y, 1 / normal.z} {}

  Offset offset(const Vec3f& q, std::size_t column_axis) const {
    Vec3d d = Vec3d(q) - centre;
    const double height = dot(d, normal);
    d[column_axis] -= height * slope_[column_axis];
    return {height, squared_norm(d)};
  }

  Vec3d centre, normal;

 private:
  Vec3d slope_;
};

double window_depth(const SurfaceCell& cell, double spacing) {
  const double deviation = std::sqrt(static_cast<double>(cell.measured) / cell.weight);
  return std::max(kDeep * deviation, spacing / 2);
}

Surfel surfel_at(const SurfaceCell& cell, double spacing) {
  return {cell.position, cell.normal, static_cast<float>(spacing), cell.information,
          static_cast<float>(window_depth(cell, spacing))};
}

/// The spacing at which the measurements of a window suffice: sigma falls as 1 / spacing, so that
/// sigma / spacing = kSharp at the geometric mean of the present spacing and sigma / kSharp.
double sufficient_spacing(double information, double spacing) {
  if (!(information > 0)) return spacing;
  const double sigma = 1 / std::sqrt(information);
  return spacing * std::clamp(std::sqrt(sigma / (kSharp * spacing)), 1.0, kWidest);
}

/// One step of the mean shift of a surfel whose column runs along `column_axis`.
Surfel shifted(const SurfaceCells& cells, Surfel surfel, std::size_t column_axis) {
  const Element element(surfel);
  const double radius = kWindow * surfel.spacing;
  const double per_radius = 1 / (radius * radius);
  const double per_depth = 1 / (static_cast<double>(surfel.depth) * surfel.depth);
  double weight = 0, height = 0, information = 0;
  Vec3d normal;
  cells.index.visit(element.centre, element.normal, radius, kAlong,
                    [&](std::uint32_t i, std::size_t axis) {
                      const SurfaceCell& cell = cells.cells[i];
                      const Element::Offset offset = element.offset(cell.position, axis);
                      const double across = 1 - offset.squared_reach * per_radius;
                      const double along = 1 - offset.height * offset.height * per_depth;
                      if (across <= 0 || along <= 0 || !agree(element.normal, cell.normal)) return;
                      const double kernel = across * across * along * along;
                      weight += kernel * cell.weight;
                      height += kernel * cell.weight * offset.height;
                      information += kernel * cell.information;
                      normal += kernel * cell.weight * Vec3d(cell.normal);
                    });
  if (!(weight > 0)) return surfel;
  const double tilt = element.normal[column_axis];
  if (std::abs(tilt) >= kAlong) {
    surfel.position[column_axis] =
        static_cast<float>(element.centre[column_axis] + height / weight / tilt);
  }
  surfel.normal = Vec3f(normalized(normal));
  surfel.information = static_cast<float>(information);
  return surfel;
}

/// Calls visit(j, offset) for the surfels of the same surface within `radius` of surfel i.
template <class Visit>
void visit_around(const Surfels& surfels, std::size_t i, double radius, const Visit& visit) {
  const Surfel& surfel = surfels.points[i];
  const Element element(surfel);
  surfels.index.visit(
      element.centre, element.normal, radius, kAlong, [&](std::uint32_t j, std::size_t axis) {
        const Surfel& other = surfels.points[j];
        const Element::Offset offset = element.offset(other.position, axis);
        if (std::abs(offset.height) <= surfel.depth && offset.squared_reach < radius * radius &&
            agree(element.normal, other.normal)) {
          visit(j, offset);
        }
      });
}

/// Whether the surface around surfel i is not the one that its column cuts: a stray normal put the
/// seed into a field along which it cannot slide, and others seed the surface there.
bool misplaced(const Surfels& surfels, std::size_t i) {
  return std::abs(surfels.points[i].normal[surfels.index.axis(i)]) < kUpright;
}

/// Whether a layer with far more support lies above or below surfel i.
bool weak(const Surfels& surfels, std::size_t i) {
  const Surfel& surfel = surfels.points[i];
  bool found = false;
  visit_around(surfels, i, surfel.spacing, [&](std::uint32_t j, const Element::Offset& offset) {
    const bool beside = std::abs(offset.height) * 3 > surfel.spacing;
    found |= beside && surfel.information < kWeak * surfels.points[j].information;
  });
  return found;
}

/// Whether most surfels within `reach` spacings of surfel i, whatever way they face, have a support
/// above `limit`.
template <class Support>
bool outdone(const Surfels& surfels, std::size_t i, double reach, double limit,
             const Support& support) {
  const double radius = reach * surfels.points[i].spacing;
  const Vec3d p(surfels.points[i].position);
  double better = 0, all = 0;
  surfels.index.visit(p, {}, radius, -1, [&](std::uint32_t j, std::size_t) {
    if (squared_norm(Vec3d(surfels.points[j].position) - p) > radius * radius) return;
    better += support(j) > limit;
    all += 1;
  });
  return better > kMost * all;
}

/// Whether the window of surfel i holds far less, for its size, than those of most around it.
bool faint(const Surfels& surfels, std::size_t i) {
  const auto density = [&](std::size_t j) {
    const double spacing = surfels.points[j].spacing;
    return surfels.points[j].information / (spacing * spacing);
  };
  return outdone(surfels, i, kAround, density(i) / kFaint, density);
}

/// Whether a kept surfel is too near to surfel i: nearer than `share` of the spacing on the same
/// surface, or nearer than half of that on any that does not face the other way.
bool crowded(const Surfels& surfels, std::size_t i, double share,
             const std::vector<std::uint8_t>& is_kept) {
  const Surfel& surfel = surfels.points[i];
  bool near = false;
  visit_around(surfels, i, share * surfel.spacing,
               [&](std::uint32_t j, const Element::Offset&) { near |= is_kept[j] != 0; });
  if (near) return true;
  const double apart = kApart * share * surfel.spacing;
  const Vec3d p(surfel.position), n(surfel.normal);
  surfels.index.visit(p, n, apart, -kAgree, [&](std::uint32_t j, std::size_t) {
    const Surfel& other = surfels.points[j];
    near |= is_kept[j] && dot(n, Vec3d(other.normal)) > -kAgree &&
            squared_norm(Vec3d(other.position) - p) < apart * apart;
  });
  return near;
}

/// Keeps, in their order, surfels that are not `left_out` and that no kept one is nearer to than
/// `share` of the spacing. False where cancelled.
bool keep_apart(Surfels& surfels, double share, const std::vector<std::uint8_t>& left_out,
                const Context& context) {
  const std::size_t count = surfels.points.size();
  std::vector<std::uint8_t> is_kept(count);
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (i % 8192 == 0 && context.cancelled()) return false;
    if (left_out[i] || crowded(surfels, i, share, is_kept)) continue;
    is_kept[i] = 1;
    kept.push_back(i);
  }
  surfels = {gather(surfels.points, kept), surfels.index.subset(kept)};
  context.progress(1);
  return true;
}

}  // namespace

Surfels seed_surfels(const SurfaceCells& cells, double spacing) {
  std::vector<std::uint32_t> seeds;
  Surfels surfels;
  const std::size_t count = cells.cells.size();
  for (std::size_t i = 0; i < count; ++i) {
    const SurfaceCell& cell = cells.cells[i];
    const std::size_t axis = cells.index.axis(i);
    const double depth = window_depth(cell, spacing);
    const auto nearby = [&](std::size_t j) {
      return cells.index.same_column(i, j) &&
             std::abs(cells.cells[j].position[axis] - cell.position[axis]) < depth;
    };
    bool largest = true;
    for (std::size_t j = i; largest && j-- > 0 && nearby(j);) {
      largest = cells.cells[j].weight < cell.weight;
    }
    for (std::size_t j = i + 1; largest && j < count && nearby(j); ++j) {
      largest = cells.cells[j].weight <= cell.weight;
    }
    if (!largest) continue;
    seeds.push_back(static_cast<std::uint32_t>(i));
    surfels.points.push_back(surfel_at(cell, spacing));
  }
  surfels.index = cells.index.subset(seeds);
  return surfels;
}

Surfels every_cell(const SurfaceCells& cells, double spacing) {
  Surfels surfels{{}, cells.index};
  for (const SurfaceCell& cell : cells.cells) surfels.points.push_back(surfel_at(cell, spacing));
  return surfels;
}

bool slide(const SurfaceCells& cells, int rounds, Surfels& surfels, const Context& context) {
  return parallel_for(
      context, surfels.points.size(),
      [&](IndexRange range) {
        for (std::size_t i = range.begin; i < range.end; ++i) {
          Surfel& surfel = surfels.points[i];
          for (int round = 0; round < rounds; ++round) {
            surfel = shifted(cells, surfel, surfels.index.axis(i));
          }
        }
      },
      512);
}

void grow(Surfels& surfels) {
  for (Surfel& surfel : surfels.points) {
    surfel.spacing = static_cast<float>(sufficient_spacing(surfel.information, surfel.spacing));
  }
}

bool thin_loosely(Surfels& surfels, const Context& context) {
  return keep_apart(surfels, kLoose, std::vector<std::uint8_t>(surfels.points.size()), context);
}

bool thin(Surfels& surfels, const Context& context) {
  std::vector<std::uint8_t> is_bad(surfels.points.size());
  const bool complete = parallel_for(context.part(0, 0.7), is_bad.size(), [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      is_bad[i] = misplaced(surfels, i) || weak(surfels, i) || faint(surfels, i);
    }
  });
  return complete && keep_apart(surfels, 1, is_bad, context.part(0.7, 1));
}

bool find_owners(const SurfaceCells& cells, const Surfels& surfels,
                 std::vector<std::uint32_t>& owners, const Context& context) {
  owners.assign(cells.cells.size(), kNoSurfel);
  std::vector<float> distances(owners.size(), static_cast<float>(kWindow * kWindow));
  for (std::uint32_t j = 0; j < surfels.points.size(); ++j) {
    if (j % 8192 == 0) {
      if (context.cancelled()) return false;
      context.progress(static_cast<double>(j) / static_cast<double>(surfels.points.size()));
    }
    const Surfel& surfel = surfels.points[j];
    const Element element(surfel);
    const double per_spacing = 1 / (static_cast<double>(surfel.spacing) * surfel.spacing);
    cells.index.visit(element.centre, element.normal, kWindow * surfel.spacing, kAlong,
                      [&](std::uint32_t i, std::size_t axis) {
                        const SurfaceCell& cell = cells.cells[i];
                        const Element::Offset offset = element.offset(cell.position, axis);
                        const float distance =
                            static_cast<float>(offset.squared_reach * per_spacing);
                        if (std::abs(offset.height) <= surfel.depth && distance < distances[i] &&
                            agree(element.normal, cell.normal)) {
                          distances[i] = distance;
                          owners[i] = j;
                        }
                      });
  }
  context.progress(1);
  return true;
}

bool find_sparse(const Surfels& surfels, const std::vector<std::uint32_t>& observations,
                 std::vector<std::uint8_t>& is_sparse, const Context& context) {
  is_sparse.assign(surfels.points.size(), 0);
  return parallel_for(context, is_sparse.size(), [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      is_sparse[i] = outdone(surfels, i, 2 * kAround, observations[i] / kSparse,
                             [&](std::size_t j) { return observations[j]; });
    }
  });
}

}  // namespace burnish
