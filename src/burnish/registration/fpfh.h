#pragma once

#include <array>
#include <span>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/vec3.h"

namespace burnish {

/// Points with a normal of unit length each.
struct OrientedPoints {
  std::vector<Vec3f> positions, normals;

  std::size_t size() const { return positions.size(); }
};

/// One point for every cubic cell of side `cell` that holds some: the mean of their positions and
/// the direction of the mean of their normals, in the order of the cells. Cells whose normals
/// cancel are left out. O(#P log #P).
OrientedPoints thinned(std::span<const Vec3f> positions, std::span<const Vec3f> normals,
                       double cell);

/// Three histograms of eleven bins, each of sum 1.
using Fpfh = std::array<float, 33>;

/// The Fast Point Feature Histogram of every point (Rusu, Blodow and Beetz 2009): of the angles
/// between its normal, those of the points within `radius` and the lines to them (eqs. 1 and 2),
/// and of their histograms, weighted by one over the distance (eq. 3). Does not change as the
/// points are moved. All 0 where there is no other point. O(#P k). None where cancelled: empty.
std::vector<Fpfh> fpfh(const OrientedPoints& points, double radius, const Context& context);

}  // namespace burnish
