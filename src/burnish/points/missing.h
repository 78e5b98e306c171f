#pragma once

#include <cstdint>
#include <vector>

#include "burnish/core/point_cloud.h"
#include "burnish/points/cleaning.h"

namespace burnish {

/// Takes the points with removed[i] != 0 out: from a grid by making them missing, from an
/// unorganized cloud by closing the gaps.
CleaningReport take_out(PointCloud& cloud, const std::vector<std::uint8_t>& removed);

}  // namespace burnish
