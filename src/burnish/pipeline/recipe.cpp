#include "burnish/pipeline/recipe.h"

#include <fmt/format.h>

namespace burnish {
namespace {

template <class Find>
Result<void> check_methods(const std::vector<Method>& methods, Find find) {
  for (const Method& method : methods) {
    const auto operation = find(method.name);
    if (!operation) return operation.error();
    if (auto settings = (*operation)->resolve(method.settings); !settings) {
      Error error = settings.error();
      error.where = method.name;
      return error;
    }
  }
  return {};
}

}  // namespace

Result<NoiseBoundParams> parse_bound(std::string_view text) {
  const Result<Method> method = parse_method(text);
  if (!method) return method.error();
  if (method->name != kNoiseBound) {
    return Error{ErrorCode::invalid_argument,
                 fmt::format("'{}' bounds no smoothing, known: {}", method->name, kNoiseBound),
                 {}};
  }
  auto params = NoiseBoundParams::schema().parse(method->settings);
  if (!params) return Error{params.error().code, params.error().message, "bound"};
  return params;
}

Result<void> check_smoothing(const std::vector<Method>& methods) {
  return check_methods(methods, find_smooth);
}

Result<void> check_simplification(const std::vector<Method>& methods) {
  return check_methods(methods, find_simplify);
}

Result<void> check_thinning(const std::vector<Method>& methods) {
  return check_methods(methods, find_thin);
}

Result<void> check_refinement(const std::vector<Method>& methods) {
  return check_methods(methods, find_refine);
}

Result<void> check_repair(const std::vector<Method>& methods) {
  return check_methods(methods, find_repair);
}

Result<void> check(const Recipe& recipe) {
  const FrameSteps& frames = recipe.frames;
  if (frames.average) {
    if (auto ok = check_methods({*frames.average}, find_average); !ok) return ok;
  }
  if (frames.frames_at_once < 1) {
    return Error{ErrorCode::invalid_argument,
                 fmt::format("{} frames are to be averaged at once, at least 1 is expected",
                             frames.frames_at_once),
                 {}};
  }
  if (auto ok = check_methods(frames.filter, find_filter); !ok) return ok;
  if (recipe.bound && !frames.filter.empty()) {
    return Error{ErrorCode::invalid_argument,
                 fmt::format("a bound holds vertices to where they were measured, and {} moves "
                             "depths before it could: leave out one of the two",
                             frames.filter.front().name),
                 {}};
  }
  if (auto ok = check_methods(recipe.clean_scan, find_clean); !ok) return ok;
  if (auto ok = check_methods({recipe.merge}, find_merge); !ok) return ok;
  if (auto ok = check_methods(recipe.clean_merged, find_clean); !ok) return ok;
  if (recipe.triangulate) {
    if (auto ok = check_methods({*recipe.triangulate}, find_triangulate); !ok) return ok;
  }
  if (auto ok = check_methods(recipe.repair, find_repair); !ok) return ok;
  if (recipe.bound) {
    if (auto valid = NoiseBoundParams::schema().check(*recipe.bound); !valid) return valid;
  }
  if (recipe.smooth_region && recipe.smooth.empty()) {
    return Error{ErrorCode::invalid_argument,
                 "a region to smooth is given, but no method to smooth with",
                 {}};
  }
  if (auto ok = check_smoothing(recipe.smooth); !ok) return ok;
  return check_simplification(recipe.simplify);
}

}  // namespace burnish
