#include "../edit_file.h"
#include "../verb.h"
#include "burnish/pipeline/phases.h"
#include "burnish/pipeline/recipe.h"

namespace burnish::app {
namespace {

struct Options {
  std::string input, output;
  ReportOutput report;
  std::vector<std::string> methods{"manifold"};
};

Result<void> repair(const Options& options, const Session& session, const Context& context) {
  const Result<std::vector<Method>> methods = parse_methods(options.methods);
  if (!methods) return methods.error();
  if (auto known = check_repair(*methods); !known) return known;

  const bool keep_phases = options.report.wanted();
  const auto run = [&](TriangleMesh& mesh, Record& record, const Context& share) {
    return repair_in_phases(mesh, *methods, keep_phases, record, share);
  };
  return edit_mesh({"Repair of", options.input, options.output, options.report}, run, session,
                   context);
}

}  // namespace

Action add_repair(CLI::App& app) {
  auto* verb = app.add_subcommand("repair", "Take out of a mesh what is not surface.");
  auto options = std::make_shared<Options>();
  verb->add_option("IN", options->input, "the mesh: PLY, OBJ, STL, OFF")->required();
  verb->add_option("-o,--output", options->output, "the file to write; its ending names the format")
      ->required();
  add_method(verb, "-m,--method", options->methods, "repair",
             "how; repeat it for one phase after another; default: manifold");
  add_report_options(verb, options->report);
  verb->footer("Methods:\n" + methods_help("repair") +
               "Examples:\n"
               "  burnish repair model.obj -o sound.ply\n"
               "  burnish repair model.obj -o largest.ply --method manifold "
               "--method small_components:largest_only=true");
  return [options](const Session& s, const Context& c) { return repair(*options, s, c); };
}

}  // namespace burnish::app
