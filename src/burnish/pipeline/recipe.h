#pragma once

#include <optional>
#include <vector>

#include "burnish/catalogue/operations.h"
#include "burnish/pipeline/region.h"
#include "burnish/smoothing/noise_bound.h"

namespace burnish {

/// What is done to depth frames before they become points.
struct FrameSteps {
  std::optional<Method> average{};  ///< of frames from one place; none: each is a scan of its own
  int frames_at_once = 30;          ///< at most so many become one, at least 1
  std::vector<Method> filter{};     ///< each frame, averaged or not
};

/// Which method does each step of a reconstruction; an empty list leaves its step out.
struct Recipe {
  FrameSteps frames;           ///< depth frames, where the input is such
  std::optional<Region> crop;  ///< world coordinates; the rest is thrown away
  std::vector<Method> clean_scan{{"flying_pixels", {}}};  ///< each scan, where it is organized
  Method merge{"cells", {}};                              ///< several scans
  std::vector<Method> clean_merged{{"outliers", {}}};     ///< the merged cloud
  std::optional<Method> triangulate;  ///< none: organized for one organized scan, else global
  std::vector<Method> repair{{"small_components", {}}};
  std::vector<Method> smooth{{"auto", {}}};  ///< phase by phase
  std::optional<Region> smooth_region;    ///< world coordinates; only vertices inside are smoothed
  std::optional<NoiseBoundParams> bound;  ///< of the smoothing; none: vertices go where it wants
  std::vector<Method> simplify{};
};

/// What bounds a smoothing, as options and records call it.
inline constexpr const char* kNoiseBound = "noise";

/// Reads "noise" or "noise:c=2". Errors: invalid_argument.
Result<NoiseBoundParams> parse_bound(std::string_view text);

/// Whether every method is known and its parameters can be, smooth_region has something to confine,
/// and a bound is not to hold vertices to depths that a filter has moved. Errors: invalid_argument.
Result<void> check(const Recipe& recipe);

/// The same for a list of methods of one family alone.
Result<void> check_smoothing(const std::vector<Method>& methods);
Result<void> check_simplification(const std::vector<Method>& methods);
Result<void> check_thinning(const std::vector<Method>& methods);
Result<void> check_refinement(const std::vector<Method>& methods);
Result<void> check_repair(const std::vector<Method>& methods);

}  // namespace burnish
