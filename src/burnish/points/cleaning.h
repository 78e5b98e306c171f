#pragma once

#include "burnish/base/facts.h"

namespace burnish {

/// What an operation that takes points out of a cloud did.
struct CleaningReport {
  std::size_t points_before = 0;  ///< with a position (missing pixels do not count)
  std::size_t points_removed = 0;

  Facts facts() const {
    return {{"points_before", static_cast<double>(points_before), ""},
            {"points_removed", static_cast<double>(points_removed), ""}};
  }
};

}  // namespace burnish
