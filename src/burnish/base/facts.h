#pragma once

#include <string>
#include <vector>

namespace burnish {

/// One thing that was measured or counted: {"moved_vertices", 35947, ""}, {"rms_move", 0.0012,
/// "m"}.
struct Fact {
  std::string key;  ///< snake_case
  double value = 0;
  std::string unit;  ///< "m", "rad", "m2", "m3", "s"; empty for counts and ratios
};

/// What an operation reports, in the order in which it is to be read.
using Facts = std::vector<Fact>;

}  // namespace burnish
