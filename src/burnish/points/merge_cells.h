#pragma once

#include <span>

#include "burnish/base/context.h"
#include "burnish/base/schema.h"
#include "burnish/points/merging.h"

namespace burnish {

struct MergeCellsParams {
  double spacing = 0;        ///< m; 0: twice the median distance between neighbouring rays
  double registration = 0;   ///< how far poses are off, one standard deviation, m; 0: estimated
  double correlation = 0.5;  ///< of the noise of neighbouring pixels of one image
  int min_observations = 3;  ///< points that fewer measurements support are left out

  static const Schema<MergeCellsParams>& schema();
};

/// One layer of points, roughly `spacing` apart, from clouds that overlap. A point is the mean of
/// the measurements of its patch, weighted by 1 / (sigma^2 + registration^2); its normal is theirs.
///
/// 1. Measurements are averaged in fine cells: columns half a spacing wide along the axis nearest
/// to
///    their normal, as deep as the noise. Sides of a sheet have opposite normals and never share
///    one.
/// 2. Every cell's mean slides along its column to where the weighted mean of all measurements lies
///    whose normals agree within 60 degrees, in a window 1.5 spacings in radius across the surface
///    and three standard deviations deep (mean shift to the moving least squares surface; cf. Levin
///    1998). Where the measurements are too few to bring sigma below a third of the spacing,
///    spacing and window grow, up to four times.
/// 3. Thinning keeps means that no kept one is nearer to than the spacing, in the order of the
///    columns; layers with a third of the support of one beside them go first.
/// 4. Every cell gives its measurements to the nearest kept point: observations is their number.
///
/// sigma = 1 / sqrt(sum of information), an upper estimate, as windows overlap. n pixels of one
/// image in one patch share `correlation` of their noise, so each adds 1 / (sigma^2 (1 + (n - 1)
/// correlation)), n from the pixel's footprint; points of unorganized clouds count as independent.
/// Errors of the poses weigh measurements and deepen windows but are no part of sigma.
///
/// Clouds need normals; points without one are left out. Without sigma in every cloud all points
/// weigh the same and the result has no sigma. Positions are relative to the first cloud's frame;
/// colours and channels are dropped. The result depends neither on threads nor, where frames agree,
/// on the order of the clouds (sums are integers). O(#P log #P); about 16 bytes a point and 100 a
/// cell. Errors: invalid_argument (no cloud, a spacing too small for the extent), bad_geometry,
/// cancelled.
Result<Merging> merge_cells(std::span<const PointCloud> clouds, const MergeCellsParams& params = {},
                            const Context& context = {});

}  // namespace burnish
