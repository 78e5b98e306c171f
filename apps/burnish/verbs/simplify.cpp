#include <fmt/format.h>

#include "../report_output.h"
#include "../summary.h"
#include "../verb.h"
#include "burnish/io/geometry_file.h"
#include "burnish/pipeline/phases.h"
#include "burnish/pipeline/recipe.h"

namespace burnish::app {
namespace {

struct Options {
  std::string input, output, target_triangles, ratio, max_error;
  ReportOutput report;
  std::vector<std::string> methods{"quadric"};
};

/// The settings that the verb's own options stand for.
Settings settings_of(const Options& options) {
  Settings settings;
  const auto add = [&settings](const char* key, const std::string& value) {
    if (!value.empty()) settings.emplace_back(key, value);
  };
  add("target_triangles", options.target_triangles);
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

Result<void> simplify(const Options& options, const Session& session, const Context& context) {
  Result<std::vector<Method>> methods = parse_methods(options.methods);
  if (!methods) return methods.error();
  const Settings own = settings_of(options);
  for (Method& method : *methods) {
    method.settings.insert(method.settings.end(), own.begin(), own.end());
  }
  if (auto known = check_simplification(*methods); !known) return known;

  if (auto possible = check_output(options.output); !possible) return possible;
  if (auto possible = check_report_output(options.report); !possible) return possible;
  context.stage("reading " + options.input);
  Result<GeometryFile> file = read_geometry(options.input, context.part(0, 0.2));
  if (!file) return std::move(file).error();

  Record record =
      new_record("Simplification of " + options.input, session.command, {options.input});
  keep_notes(options.input, *file, record);
  Result<TriangleMesh> mesh = mesh_of(*std::move(file), options.input);
  if (!mesh) return std::move(mesh).error();
  if (auto done = simplify_in_phases(*mesh, *methods, options.report.wanted(), record,
                                     context.part(0.2, 0.7));
      !done) {
    return done;
  }
  if (auto written =
          save(options.output, *mesh, session, context.part(0.7, 0.8), comments_of(record));
      !written) {
    return written;
  }
  say_steps(session, record);
  return write_report_output(options.report, record, session, context.part(0.8, 1));
}

}  // namespace

Action add_simplify(CLI::App& app) {
  auto* verb = app.add_subcommand("simplify", "Make a mesh of fewer triangles.");
  auto options = std::make_shared<Options>();
  verb->add_option("IN", options->input, "the mesh: PLY, OBJ, STL, OFF")->required();
  verb->add_option("-o,--output", options->output, "the file to write; its ending names the format")
      ->required();
  add_method(verb, "-m,--method", options->methods, "simplify",
             "how; repeat it for one phase after another; default: quadric");
  verb->add_option("--target_triangles", options->target_triangles, "stop at so many triangles");
  verb->add_option("--ratio", options->ratio, "stop at this share of the triangles: 0.1");
  verb->add_option("--max_error", options->max_error,
                   "never farther from the original, nor it from the result: 1mm; or noise[:c=1]: "
                   "c times each vertex's own sigma");
  add_report_options(verb, options->report);
  verb->footer(
      "With no target and no bound half of the triangles go. With several, the first that is\n"
      "reached ends it. A surface never folds over, and keeps its boundaries, its orientation and\n"
      "its Euler number; places that are no surface (an edge of three triangles) stay as they "
      "are.\n"
      "Methods:\n" +
      methods_help("simplify") +
      "Examples:\n"
      "  burnish simplify scan.ply -o small.ply --ratio 0.1\n"
      "  burnish simplify scan.ply -o small.ply --max_error 1mm\n"
      "  burnish simplify scan.ply -o small.ply --max_error noise --method point_removal");
  return [options](const Session& s, const Context& c) { return simplify(*options, s, c); };
}

}  // namespace burnish::app
