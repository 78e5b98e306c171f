#pragma once

#include <array>

#include "burnish/core/attributes.h"

namespace burnish {

/// The inverse of a covariance, 1/m^2: xx, yy, zz, xy, yz, zx. Those of independent measurements
/// add up.
using Precision = std::array<double, 6>;

/// The precision of one measurement whose deviations count as at least `least` (m, positive).
Precision precision_of(const PointNoise& noise, double least);

/// The noise that a precision means. Its ellipsoid of one standard deviation need not be round
/// about any axis: what comes is the largest spheroid within it that shares its axes, so that
/// nothing is promised that the measurements do not bear out. The axis points to where `normal`
/// comes from, as a ray does. A precision that is not positive (rounded sums of nearly nothing)
/// counts as a millionth of its largest direction's.
PointNoise noise_within(const Precision& precision, const Vec3f& normal);

}  // namespace burnish
