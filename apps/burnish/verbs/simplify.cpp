#include <fmt/format.h>

#include "../edit_file.h"
#include "../summary.h"
#include "../verb.h"
#include "burnish/io/geometry_file.h"
#include "burnish/pipeline/phases.h"
#include "burnish/pipeline/recipe.h"

namespace burnish::app {
namespace {

struct Options {
  std::string input, output, target_triangles, target_points, ratio, max_error;
  ReportOutput report;
  std::vector<std::string> methods;
};

/// The settings that the verb's own options stand for.
Settings settings_of(const Options& options) {
  Settings settings;
  const auto add = [&settings](const char* key, const std::string& value) {
    if (!value.empty()) settings.emplace_back(key, value);
  };
  add("target_triangles", options.target_triangles);
  add("target_points", options.target_points);
  add("ratio", options.ratio);
  constexpr std::string_view kNoise = "noise", kSigmas = "noise:c=";
  if (options.max_error == kNoise) {
    add("max_sigmas", "1");
  } else if (options.max_error.starts_with(kSigmas)) {
    add("max_sigmas", options.max_error.substr(kSigmas.size()));
  } else {
    add("max_error", options.max_error);
  }
  return settings;
}

/// The methods asked for, or the family's usual one, with the verb's own settings.
Result<std::vector<Method>> methods_of(const Options& options, const char* usual,
                                       Result<void> (*check)(const std::vector<Method>&)) {
  Result<std::vector<Method>> methods = std::vector{Method{usual, {}}};
  if (!options.methods.empty()) methods = parse_methods(options.methods);
  if (!methods) return methods;
  const Settings own = settings_of(options);
  if (methods->size() > 1 && !own.empty()) {
    return Error{ErrorCode::invalid_argument,
                 "with several methods each has a target and a bound of its own: --method "
                 "quadric:ratio=0.5 in place of --" +
                     own.front().first,
                 "--method"};
  }
  for (const auto& [key, value] : own) {
    const auto number =
        parse_quantity(value, key == "max_error" ? Quantity::length : Quantity::number);
    if (number && *number <= 0) {
      return Error{ErrorCode::invalid_argument,
                   fmt::format("'{}' was given, more than 0 was expected", value), "--" + key};
    }
  }
  for (Method& method : *methods) {
    method.settings.insert(method.settings.end(), own.begin(), own.end());
  }
  if (auto known = check(*methods); !known) return known.error();
  return methods;
}

Result<void> simplify_mesh(TriangleMesh mesh, const Options& options, Record& record,
                           const Session& session, const Context& context) {
  const auto methods = methods_of(options, "quadric", check_simplification);
  if (!methods) return methods.error();
  if (auto done =
          simplify_in_phases(mesh, *methods, options.report.wanted(), record, context.part(0, 0.8));
      !done) {
    return done;
  }
  return save(options.output, mesh, session, context.part(0.8, 1), comments_of(record));
}

Result<void> thin_points(PointCloud cloud, const Options& options, Record& record,
                         const Session& session, const Context& context) {
  const auto methods = methods_of(options, "fan_cloud", check_thinning);
  if (!methods) return methods.error();
  if (auto done = thin_cloud(cloud, *methods, record, context.part(0, 0.8)); !done) return done;
  say_methods(session, record);
  return save(options.output, cloud, session, context.part(0.8, 1));
}

Result<void> simplify(const Options& options, const Session& session, const Context& context) {
  const auto run = [&](GeometryFile file, Record& record, const Context& share) {
    return file.mesh.triangles.empty()
               ? thin_points(cloud_of(std::move(file)), options, record, session, share)
               : simplify_mesh(std::move(file.mesh), options, record, session, share);
  };
  return edit_file({"Simplification of", options.input, options.output, options.report}, run,
                   session, context);
}

}  // namespace

Action add_simplify(CLI::App& app) {
  auto* verb =
      app.add_subcommand("simplify", "Make a mesh of fewer triangles, or a cloud of fewer points.");
  auto options = std::make_shared<Options>();
  verb->add_option("IN", options->input,
                   "the mesh: PLY, OBJ, STL, OFF; or the cloud: PLY, PCD, XYZ")
      ->required();
  verb->add_option("-o,--output", options->output, "the file to write; its ending names the format")
      ->required();
  add_method(verb, "-m,--method", options->methods, "simplify",
             "how; repeat it for one phase after another; default: quadric, of a cloud fan_cloud");
  verb->add_option("--target_triangles", options->target_triangles, "stop at so many triangles");
  verb->add_option("--target_points", options->target_points, "of a cloud: stop at so many points");
  verb->add_option("--ratio", options->ratio, "stop at this share of the triangles or points: 0.1");
  verb->add_option("--max_error", options->max_error,
                   "never farther from the original, nor it from the result: 1mm; or noise[:c=1]: "
                   "c times each vertex's own sigma");
  add_report_options(verb, options->report);
  verb->footer(
      "With no target and no bound half of the triangles go. With several, the first that is\n"
      "reached ends it. A surface never folds over, and keeps its boundaries, its orientation and\n"
      "its Euler number; places that are no surface (an edge of three triangles) stay as they "
      "are.\n"
      "Of a cloud, the points go that carry least information; those that are left do not move.\n"
      "Methods for meshes:\n" +
      methods_help("simplify") + "Methods for clouds:\n" + methods_help("thin") +
      "Examples:\n"
      "  burnish simplify scan.ply -o small.ply --ratio 0.1\n"
      "  burnish simplify scan.ply -o small.ply --max_error 1mm\n"
      "  burnish simplify scan.ply -o small.ply --max_error noise --method point_removal\n"
      "  burnish simplify cloud.pcd -o thin.pcd --target_points 20000");
  return [options](const Session& s, const Context& c) { return simplify(*options, s, c); };
}

}  // namespace burnish::app
