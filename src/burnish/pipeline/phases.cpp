#include "burnish/pipeline/phases.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <type_traits>

#include "burnish/adaptation/refinement.h"
#include "burnish/base/version.h"
#include "burnish/pipeline/confinement.h"
#include "burnish/pipeline/recipe.h"
#include "burnish/smoothing/smoothing_weights.h"

namespace burnish {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Error in_step(std::string_view verb, const Method& method, Error error) {
  if (error.code == ErrorCode::cancelled) return error;
  const std::string step = fmt::format("{} {}", verb, method.name);
  error.where = error.where.empty() ? step : fmt::format("{}, {}", step, error.where);
  return error;
}

/// Runs one method and records it. `run` calls the operation, `facts_of` reads its result.
template <class Op, class Run, class FactsOf>
auto recorded(std::string_view verb, const Result<const Op*>& operation, const Method& method,
              Record& record, const Context& context, Run run, FactsOf facts_of)
    -> decltype(run(**operation)) {
  if (!operation) return operation.error();
  const Result<Settings> settings = (*operation)->resolve(method.settings);
  if (!settings) return in_step(verb, method, settings.error());
  context.stage(fmt::format("{}: {}", verb, method.name));
  const auto start = std::chrono::steady_clock::now();
  auto result = run(**operation);
  if (!result) return in_step(verb, method, std::move(result).error());
  record.steps.push_back({std::string(verb), method.name, *settings, facts_of(*result),
                          seconds_since(start), (*operation)->info.fields});
  return result;
}

/// Runs methods one after another: `run` calls an operation, `after` is told when it is done.
template <class Find, class Run, class After>
Result<void> run_all(std::string_view verb, const std::vector<Method>& methods, Find find,
                     Record& record, const Context& context, Run run, After after) {
  const double count = static_cast<double>(methods.size());
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const double done = static_cast<double>(i);
    const Context share = context.part(done / count, (done + 1) / count);
    const auto facts = recorded(
        verb, find(methods[i].name), methods[i], record, share,
        [&](const auto& operation) { return run(operation, methods[i].settings, share); },
        [](const Facts& measured) { return measured; });
    if (!facts) return facts.error();
    if constexpr (std::is_void_v<decltype(after(i))>) {
      after(i);
    } else {
      if (auto ok = after(i); !ok) return ok;
    }
  }
  return {};
}

/// Runs methods that edit `edited`, one after another.
template <class T, class Find>
Result<void> edit(std::string_view verb, T& edited, const std::vector<Method>& methods, Find find,
                  Record& record, const Context& context) {
  return run_all(
      verb, methods, find, record, context,
      [&](const auto& operation, const Settings& settings, const Context& share) {
        return operation.run(edited, settings, share);
      },
      [](std::size_t) {});
}

/// Runs a method that makes something of `input`.
template <class Op, class T>
auto create(std::string_view verb, const Result<const Op*>& operation, const T& input,
            const Method& method, Record& record, const Context& context) {
  const auto run = [&](const Op& op) { return op.run(input, method.settings, context); };
  auto created = recorded(verb, operation, method, record, context, run,
                          [](const auto& made) { return made.facts; });
  using Made = decltype(created->value);
  return created ? Result<Made>(std::move(created->value))
                 : Result<Made>(std::move(created).error());
}

/// Keeps the mesh at the moments that a report shows, where one is wanted: as it is first, then
/// after each method, one numbered after the other also where several steps follow each other.
class Phases {
 public:
  Phases(const TriangleMesh& mesh, bool wanted, Record& record)
      : mesh_(mesh), wanted_(wanted), record_(record) {
    if (record.phases.empty()) keep("original");
  }
  void keep_next() { keep(fmt::format("phase {}", record_.phases.size())); }

 private:
  void keep(std::string name) {
    if (wanted_) record_.phases.push_back({std::move(name), mesh_, {}});
  }

  const TriangleMesh& mesh_;
  bool wanted_;
  Record& record_;
};

/// Runs methods that edit a mesh, and keeps what comes of each.
template <class Find>
Result<void> edit_in_phases(std::string_view verb, TriangleMesh& mesh,
                            const std::vector<Method>& methods, Find find, bool keep_phases,
                            Record& record, const Context& context) {
  Phases phases(mesh, keep_phases, record);
  return run_all(
      verb, methods, find, record, context,
      [&mesh](const auto& operation, const Settings& settings, const Context& share) {
        return operation.run(mesh, settings, share);
      },
      [&phases](std::size_t) { phases.keep_next(); });
}

/// The record's line on a region that an operation is confined to.
Step confining(const Region& region, const std::vector<float>& weights, const char* vertices,
               const char* help) {
  const auto free =
      weights.size() - static_cast<std::size_t>(std::count(weights.begin(), weights.end(), 0.0f));
  return {"confine",
          "region",
          {{"region", to_string(region)}},
          {{vertices, static_cast<double>(free), ""}},
          0,
          {{"region", "region", "", "", "", help}}};
}

Error in_bound(Error error) {
  return in_step("bound", {kNoiseBound, {}}, std::move(error));
}

/// Binds what a phase has moved to the noise, and records it.
Result<void> put_back(const TriangleMesh& before, TriangleMesh& mesh,
                      const NoiseBoundParams& params, Record& record, const Context& context) {
  const auto start = std::chrono::steady_clock::now();
  const auto report = bound_to_noise(before, mesh, params, context);
  if (!report) return in_bound(report.error());
  const auto& schema = NoiseBoundParams::schema();
  record.steps.push_back({"bound", kNoiseBound, schema.settings(params), report->facts(),
                          seconds_since(start), schema.fields()});
  return {};
}

Result<void> certify(const TriangleMesh& before, const TriangleMesh& mesh, double c,
                     Record& record) {
  Result<NoiseCertificate> certificate = certify_noise_bound(before, mesh, c);
  if (!certificate) return in_bound(certificate.error());
  if (!certificate->holds()) {
    return in_bound({ErrorCode::refuted, sentences(*certificate).front(), {}});
  }
  record.certificate = *std::move(certificate);
  return {};
}

}  // namespace

Result<DepthFrame> average_frames(std::span<const DepthFrame> frames, const Method& method,
                                  Record& record, const Context& context) {
  return create("average", find_average(method.name), frames, method, record, context);
}

Result<void> filter_frame(DepthFrame& frame, const std::vector<Method>& methods, Record& record,
                          const Context& context) {
  return edit("filter", frame, methods, find_filter, record, context);
}

Result<void> clean_cloud(PointCloud& cloud, const std::vector<Method>& methods, Record& record,
                         const Context& context) {
  return edit("clean", cloud, methods, find_clean, record, context);
}

Result<PointCloud> merge_clouds(std::span<const PointCloud> clouds, const Method& method,
                                Record& record, const Context& context) {
  return create("merge", find_merge(method.name), clouds, method, record, context);
}

Result<void> thin_cloud(PointCloud& cloud, const std::vector<Method>& methods, Record& record,
                        const Context& context) {
  return edit("thin", cloud, methods, find_thin, record, context);
}

Result<TriangleMesh> triangulate_cloud(const PointCloud& cloud, const Method& method,
                                       Record& record, const Context& context) {
  auto mesh = create("triangulate", find_triangulate(method.name), cloud, method, record, context);
  if (mesh && mesh->triangles.empty()) {
    return in_step("triangulate", method,
                   {ErrorCode::bad_geometry,
                    fmt::format("no triangle came of {} points", cloud.positions.size()),
                    {}});
  }
  return mesh;
}

Result<void> repair_mesh(TriangleMesh& mesh, const std::vector<Method>& methods, Record& record,
                         const Context& context) {
  return edit("repair", mesh, methods, find_repair, record, context);
}

Result<void> repair_in_phases(TriangleMesh& mesh, const std::vector<Method>& methods,
                              bool keep_phases, Record& record, const Context& context) {
  return edit_in_phases("repair", mesh, methods, find_repair, keep_phases, record, context);
}

Result<void> simplify_in_phases(TriangleMesh& mesh, const std::vector<Method>& methods,
                                bool keep_phases, Record& record, const Context& context) {
  return edit_in_phases("simplify", mesh, methods, find_simplify, keep_phases, record, context);
}

Result<void> smooth_in_phases(TriangleMesh& mesh, const std::vector<Method>& methods,
                              const SmoothingLimits& limits, bool keep_phases, Record& record,
                              const Context& context) {
  std::vector<float> weights;
  if (limits.region) {
    const Result<std::vector<bool>> inside = vertices_inside(mesh, *limits.region);
    if (!inside) return inside.error();
    Result<std::vector<float>> confined = confined_weights(mesh, kSmoothingWeight, *inside);
    if (!confined) return std::move(confined).error();
    weights = *std::move(confined);
    record.steps.push_back(
        confining(*limits.region, weights, "free_vertices", "where vertices are free to move"));
  }
  TriangleMesh before;
  if (limits.bound) {
    if (auto known = check_noise(mesh); !known) return in_bound(known.error());
    before = mesh;
  }
  Phases phases(mesh, keep_phases, record);
  const auto smooth = [&](const SmoothOperation& operation, const Settings& settings,
                          const Context& share) {
    if (!limits.region) return operation.run(mesh, settings, share);
    const TemporaryWeights confined(mesh, kSmoothingWeight, weights);
    return operation.run(mesh, settings, share);
  };
  Context silent = context;
  silent.sink = nullptr;  // the bar belongs to the phases; to bind one takes next to no time
  const auto after_phase = [&](std::size_t) -> Result<void> {
    if (limits.bound) {
      if (auto done = put_back(before, mesh, *limits.bound, record, silent); !done) return done;
    }
    phases.keep_next();
    return {};
  };
  if (auto done = run_all("smooth", methods, find_smooth, record, context, smooth, after_phase);
      !done) {
    return done;
  }
  return limits.bound ? certify(before, mesh, limits.bound->c, record) : Result<void>();
}

Result<void> refine_in_phases(TriangleMesh& mesh, const std::vector<Method>& methods,
                              const std::optional<Region>& region, bool keep_phases, Record& record,
                              const Context& context) {
  Phases phases(mesh, keep_phases, record);
  const auto refine = [&](const RefineOperation& operation, const Settings& settings,
                          const Context& share) -> Result<Facts> {
    if (!region) return operation.run(mesh, settings, share);
    const Result<std::vector<bool>> inside = corners_of_triangles_in(mesh, *region);
    if (!inside) return inside.error();
    const auto weights = confined_weights(mesh, kRefinement, *inside);
    if (!weights) return weights.error();
    record.steps.push_back(confining(*region, *weights, "corners_of_triangles_in_it",
                                     "triangles that have a point in it are refined"));
    const TemporaryWeights confined(mesh, kRefinement, *weights);
    return operation.run(mesh, settings, share);
  };
  return run_all("refine", methods, find_refine, record, context, refine,
                 [&phases](std::size_t) { phases.keep_next(); });
}

Record new_record(std::string title, std::string command, std::vector<std::string> inputs) {
  Record record;
  record.title = std::move(title);
  record.command = std::move(command);
  record.inputs = std::move(inputs);
  record.versions = {{"burnish", kVersion}, {"compiler", __VERSION__}};
  return record;
}

}  // namespace burnish
