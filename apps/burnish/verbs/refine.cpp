#include <fmt/format.h>

#include "../edit_file.h"
#include "../verb.h"
#include "burnish/io/geometry_file.h"
#include "burnish/pipeline/phases.h"
#include "burnish/pipeline/recipe.h"

namespace burnish::app {
namespace {

struct Options {
  std::string input, output, region;
  ReportOutput report;
  std::vector<std::string> methods{"loop"};
};

Result<void> refine(const Options& options, const Session& session, const Context& context) {
  const Result<std::vector<Method>> methods = parse_methods(options.methods);
  if (!methods) return methods.error();
  if (auto known = check_refinement(*methods); !known) return known;
  const Result<std::optional<Region>> region = parse_region_option(options.region, "--region");
  if (!region) return region.error();

  const bool keep_phases = options.report.wanted();
  const auto run = [&](TriangleMesh& mesh, Record& record, const Context& share) {
    return refine_in_phases(mesh, *methods, *region, keep_phases, record, share);
  };
  return edit_mesh({"Refinement of", options.input, options.output, options.report}, run, session,
                   context);
}

}  // namespace

Action add_refine(CLI::App& app) {
  auto* verb = app.add_subcommand("refine", "Make the triangles of a mesh smaller.");
  auto options = std::make_shared<Options>();
  verb->add_option("IN", options->input, "the mesh: PLY, OBJ, STL, OFF")->required();
  verb->add_option("-o,--output", options->output, "the file to write; its ending names the format")
      ->required();
  add_method(verb, "-m,--method", options->methods, "refine",
             "how; repeat it for one phase after another; default: loop");
  verb->add_option("--region", options->region,
                   "refine only triangles with a point in box:x0,y0,z0,x1,y1,z1 or "
                   "sphere:x,y,z,radius (world, m), and fit those around");
  add_report_options(verb, options->report);
  verb->footer(
      "Methods:\n" + methods_help("refine") +
      "Old vertices keep their numbers; new ones follow and are marked interpolated. A float "
      "property refinement\n"
      "of a PLY's vertices says where to refine: around those that have 1. With --region it counts "
      "inside.\n"
      "Examples:\n"
      "  burnish refine scan.ply -o fine.ply --method split:target_edge_length=2mm\n"
      "  burnish refine coarse.ply -o round.ply --method loop:iterations=2 "
      "--region sphere:0,0,0.3,5cm\n"
      "  burnish refine coarse.ply -o round.ply --method split:max_chord=0.1mm");
  return [options](const Session& s, const Context& c) { return refine(*options, s, c); };
}

}  // namespace burnish::app
