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
  int min_observations = 1;  ///< points that fewer measurements support are left out

  static const Schema<MergeCellsParams>& schema();
};

/// One layer of points, roughly `spacing` apart, from clouds that overlap. A point is the mean of
/// the measurements of its patch, weighted by 1 / (sigma^2 + registration^2); its normal is theirs.
///
/// 1. Measurements are averaged in fine cells: columns half a spacing wide along the axis nearest
///    to their normal, as deep as the noise. Sides of a sheet have opposite normals and share none.
/// 2. Where a column holds most, a seed slides along it to where the weighted mean of all
///    measurements lies whose normals agree within 60 degrees, in a window 1.5 spacings in radius
///    across the surface and three standard deviations deep to either side (mean shift to a moving
///    least squares surface; cf. Levin 1998). Where measurements are too few to bring sigma below a
///    third of the spacing, spacing and window grow, up to four times.
/// 3. Left out are seeds whose normal turns away from their column as they slide (a stray normal
///    put them there), those with less than a third of the support of a layer beside them, and
///    those with less than a quarter of what most seeds within three spacings have: the frayed
///    edges of scans. Support counts relative to the surroundings, so that what a single frame saw
///    stays where no other saw it.
/// 4. Of the others stay, in the order of the columns, those that no kept one is nearer to than the
///    spacing. Every cell gives its measurements to the nearest: observations is their number.
///    Points with less than a quarter of the observations of most within six spacings are left out
///    too.
///
/// sigma = 1 / sqrt(sum of information), an upper estimate, as windows are wider than patches.
/// n pixels of one image in a patch share `correlation` of their noise, so each of them adds
/// 1 / (sigma^2 (1 + (n - 1) correlation)), n from the pixel's footprint; points of unorganized
/// clouds count as independent. The noise comes of the sum of the same shares of the inverse
/// covariances (see precision.h), where every cloud has noise: views from several sides leave a
/// smaller region than any of them. Pixels within two of an outline (of missing ones or of
/// something a depth jump farther) may have seen what lies beside the surface: they add a
/// sixteenth, so that they yield where other frames saw the place from within. What poses are off
/// weighs measurements and deepens windows but is no part of sigma. It is estimated from how far
/// measurements scatter beyond their sigma about their common surface; frames that are off by more
/// than about three times that make a layer of their own.
///
/// Clouds need normals; points without one are left out. Without sigma in every cloud all points
/// weigh the same and the result has neither sigma nor noise. Positions are relative to the first
/// cloud's frame; colours and channels are dropped. The result depends neither on threads nor,
/// where frames agree, on the order of the clouds (sums are integers). O(#P log #P); about 16 bytes
/// a point and 125 a cell. Errors: invalid_argument (no cloud, a spacing too small for the extent),
/// bad_geometry, cancelled.
Result<Merging> merge_cells(std::span<const PointCloud> clouds, const MergeCellsParams& params = {},
                            const Context& context = {});

}  // namespace burnish
