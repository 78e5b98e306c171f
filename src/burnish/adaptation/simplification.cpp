#include "burnish/adaptation/simplification.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "burnish/adaptation/decimation.h"
#include "burnish/adaptation/merged_attributes.h"

namespace burnish {
namespace {

/// The number of triangles to go down to: the larger of the targets; 0 where only a bound is set.
std::size_t target_of(const SimplifyParams& params, std::size_t triangles) {
  const bool free = params.target_triangles == 0 && params.max_error == 0 && params.max_sigmas == 0;
  const double ratio = params.ratio == 0 && free ? 0.5 : params.ratio;
  return std::max(static_cast<std::size_t>(params.target_triangles),
                  static_cast<std::size_t>(std::llround(ratio * static_cast<double>(triangles))));
}

/// Per triangle how far the surface may be from it: max_error, or max_sigmas times the least sigma
/// of its vertices, whichever is less. Empty where neither is set.
Result<std::vector<float>> limits_of(const SimplifyParams& params, const TriangleMesh& mesh) {
  std::vector<float> limits;
  if (params.max_error == 0 && params.max_sigmas == 0) return limits;
  const std::vector<float>& sigma = mesh.attributes.sigma;
  // A limit that is rounded up would let through more than was asked for.
  const auto rounded_down = [](double limit) {
    const auto nearest = static_cast<float>(limit);
    return nearest > limit ? std::nextafter(nearest, 0.f) : nearest;
  };
  if (params.max_sigmas > 0 && sigma.empty()) {
    return Error{ErrorCode::bad_geometry,
                 "the error is to be bounded by the vertices' own sigma, and they have none",
                 "sigma"};
  }
  for (std::size_t v = 0; params.max_sigmas > 0 && v < sigma.size(); ++v) {
    if (!std::isfinite(sigma[v]) || sigma[v] < 0) {
      return Error{
          ErrorCode::bad_geometry,
          fmt::format("a sigma of {} m is none; a finite one, not below 0, was expected", sigma[v]),
          fmt::format("vertex {}", v)};
    }
  }
  constexpr float kNoLimit = std::numeric_limits<float>::infinity();
  limits.assign(mesh.triangles.size(),
                params.max_error > 0 ? rounded_down(params.max_error) : kNoLimit);
  for (std::size_t t = 0; params.max_sigmas > 0 && t < limits.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const double least = std::min({sigma[a], sigma[b], sigma[c]});
    limits[t] = std::min(limits[t], rounded_down(params.max_sigmas * least));
  }
  return limits;
}

/// `mesh` after the collapses of `decimation`.
TriangleMesh decimated(const TriangleMesh& mesh, const Decimation& decimation) {
  const std::vector<Removal>& removals = decimation.removals();
  TriangleMesh result{mesh.positions, mesh.triangles, mesh.attributes, mesh.frame,
                      mesh.triangle_attributes};
  keep_triangles(result, decimation.numbers());
  result.triangles = decimation.triangles_left();
  std::copy(decimation.positions().begin(), decimation.positions().end(), result.positions.begin());
  merge_attributes(result.attributes, removals, decimation.shares());

  constexpr std::uint32_t kGone = ~0u;
  std::vector<std::uint32_t> renamed(mesh.positions.size(), 0), kept;
  for (const Removal& removal : removals) renamed[removal.vertex] = kGone;
  for (std::uint32_t v = 0; v < renamed.size(); ++v) {
    if (renamed[v] == kGone) continue;
    renamed[v] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(v);
  }
  for (std::size_t k = removals.size(); k-- > 0;) {
    renamed[removals[k].vertex] = renamed[removals[k].into];
  }
  for (Triangle& triangle : result.triangles) {
    for (std::uint32_t& v : triangle) v = renamed[v];
  }
  for (std::uint32_t& v : result.triangle_attributes.owner) v = renamed[v];
  result.positions = gather(result.positions, kept);
  result.attributes = gather(result.attributes, kept);
  return result;
}

}  // namespace

const Schema<SimplifyParams>& SimplifyParams::schema() {
  using P = SimplifyParams;
  static const auto schema =
      Schema<P>()
          .integer("target_triangles", &P::target_triangles, at_least(0),
                   "stop at so many triangles; 0: no such target")
          .real("ratio", &P::ratio, between(0, 1),
                "stop at this share of the triangles; 0: half of them where nothing else is set")
          .real("max_error", &P::max_error, at_least(0),
                "keep both surfaces within this distance of each other; 0: no such bound",
                Quantity::length)
          .real("max_sigmas", &P::max_sigmas, at_least(0),
                "keep them within so many times each vertex's own sigma; 0: no such bound");
  return schema;
}

Facts SimplifyReport::facts() const {
  Facts facts{{"triangles_before", static_cast<double>(triangles_before), ""},
              {"triangles", static_cast<double>(triangles), ""},
              {"removed_vertices", static_cast<double>(removed_vertices), ""},
              {"target_reached", target_reached ? 1. : 0., ""}};
  if (error_bound) facts.push_back({"error_bound", *error_bound, "m"});
  return facts;
}

Result<SimplifyReport> simplify(TriangleMesh& mesh, Placement placement,
                                const SimplifyParams& params, const Context& context) {
  if (auto valid = SimplifyParams::schema().check(params); !valid) return valid.error();
  if (auto sound = check_decimated(mesh); !sound) return sound.error();
  Result<std::vector<float>> limits = limits_of(params, mesh);
  if (!limits) return std::move(limits).error();
  std::optional<DeviationBound> bound;
  if (!limits->empty()) bound.emplace(*std::move(limits));

  const std::size_t target = target_of(params, mesh.triangles.size());
  const bool aimed = target > 0 || params.ratio > 0;
  Decimation decimation(mesh, placement, std::move(bound), context);
  if (auto done = decimation.run(target, context.part(0, 0.9)); !done) return done.error();
  TriangleMesh result = decimated(mesh, decimation);
  if (context.cancelled()) return cancelled();

  SimplifyReport report;
  report.triangles_before = mesh.triangles.size();
  report.triangles = result.triangles.size();
  report.removed_vertices = mesh.positions.size() - result.positions.size();
  report.target_reached = !aimed || result.triangles.size() <= target;
  report.error_bound = decimation.largest_error();
  std::swap(mesh, result);
  context.progress(1);
  return report;
}

}  // namespace burnish
