#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/points/surface_cells.h"

namespace burnish {

/// A point on its way to the surface that the cells around it make.
struct Surfel {
  Vec3f position, normal;
  float spacing = 0;      ///< wanted around it, m
  float information = 0;  ///< of its window, 1/m^2
  float depth = 0;        ///< half the depth of its window, m
};

/// Surfels and where they are.
struct Surfels {
  std::vector<Surfel> points;
  ColumnIndex index;
};

constexpr std::uint32_t kNoSurfel = std::numeric_limits<std::uint32_t>::max();

/// One surfel for each surface that a column of cells cuts: at the cells with the largest weight
/// within three standard deviations of the column.
Surfels seed_surfels(const SurfaceCells& cells, double spacing);

/// A surfel at every cell.
Surfels every_cell(const SurfaceCells& cells, double spacing);

/// Slides surfels along their columns to where the weighted mean of the cells lies whose normals
/// agree within 60 degrees, in windows 1.5 spacings in radius across the surface and three standard
/// deviations deep to either side: `rounds` of mean shift. False where cancelled.
[[nodiscard]] bool slide(const SurfaceCells& cells, int rounds, Surfels& surfels,
                         const Context& context);

/// Widens the spacing of surfels to what brings sigma to a third of it, at most four times.
void grow(Surfels& surfels);

/// Keeps, in their order, surfels to which no kept one is nearer than a third of their spacing:
/// enough to choose from, where neighbours have grown many times wider than a column. False where
/// cancelled.
[[nodiscard]] bool thin_loosely(Surfels& surfels, const Context& context);

/// Keeps, in their order, surfels to which no kept one is nearer than their spacing, without those
/// - whose normal has turned away from their column, as only a stray normal put them there;
/// - that have less than a third of the support of a layer above or below them;
/// - that have less than a quarter of the support of most others within three spacings.
/// False where cancelled.
[[nodiscard]] bool thin(Surfels& surfels, const Context& context);

/// For every cell the nearest surfel of its surface within 1.5 spacings, or kNoSurfel. False where
/// cancelled.
[[nodiscard]] bool find_owners(const SurfaceCells& cells, const Surfels& surfels,
                               std::vector<std::uint32_t>& owners, const Context& context);

/// Marks surfels with less than a quarter of the observations that most within six spacings have.
/// False where cancelled.
[[nodiscard]] bool find_sparse(const Surfels& surfels,
                               const std::vector<std::uint32_t>& observations,
                               std::vector<std::uint8_t>& is_sparse, const Context& context);

}  // namespace burnish
