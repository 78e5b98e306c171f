#pragma once

#include "burnish/base/facts.h"
#include "burnish/core/point_cloud.h"

namespace burnish {

/// What a merging of clouds did.
struct MergingReport {
  std::size_t clouds = 0;
  std::size_t points_in = 0;  ///< with a position
  std::size_t points_out = 0;
  double spacing = 0;  ///< aimed at between neighbouring points, m

  Facts facts() const {
    return {{"clouds", static_cast<double>(clouds), ""},
            {"points_in", static_cast<double>(points_in), ""},
            {"points_out", static_cast<double>(points_out), ""},
            {"spacing", spacing, "m"}};
  }
};

/// One unorganized cloud from several, and how it came about.
struct Merging {
  PointCloud cloud;
  MergingReport report;
};

}  // namespace burnish
