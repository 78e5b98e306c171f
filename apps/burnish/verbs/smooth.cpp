#include <fmt/format.h>

#include "../edit_file.h"
#include "../verb.h"
#include "burnish/io/geometry_file.h"
#include "burnish/pipeline/phases.h"
#include "burnish/pipeline/recipe.h"

namespace burnish::app {
namespace {

struct Options {
  std::string input, output, region, bound;
  ReportOutput report;
  std::vector<std::string> methods;
};

Result<void> smooth(const Options& options, const Session& session, const Context& context) {
  const Result<std::vector<Method>> methods =
      options.methods.empty() ? Recipe().smooth : parse_methods(options.methods);
  if (!methods) return methods.error();
  if (auto known = check_smoothing(*methods); !known) return known;
  const Result<std::optional<Region>> region = parse_region_option(options.region, "--region");
  if (!region) return region.error();
  const auto bound = bound_of(options.bound);
  if (!bound) return bound.error();

  const bool keep_phases = options.report.wanted();
  const auto run = [&](TriangleMesh& mesh, Record& record, const Context& share) {
    return smooth_in_phases(mesh, *methods, {*region, *bound}, keep_phases, record, share);
  };
  return edit_mesh({"Smoothing of", options.input, options.output, options.report}, run, session,
                   context);
}

}  // namespace

Action add_smooth(CLI::App& app) {
  auto* verb = app.add_subcommand("smooth", "Smooth a mesh.");
  auto options = std::make_shared<Options>();
  verb->add_option("IN", options->input, "the mesh: PLY, OBJ, STL, OFF")->required();
  verb->add_option("-o,--output", options->output, "the file to write; its ending names the format")
      ->required();
  add_method(verb, "-m,--method", options->methods, "smooth",
             "how; repeat it for one phase after another; default: auto, which needs no setting");
  verb->add_option(
      "--region", options->region,
      "smooth only vertices in box:x0,y0,z0,x1,y1,z1 or sphere:x,y,z,radius (world, m)");
  add_bound(verb, options->bound);
  add_report_options(verb, options->report);
  verb->footer(
      "Methods:\n" + methods_help("smooth") +
      "A float property smoothing_weight of a PLY's vertices says how far each of them follows: 0 "
      "pins it,\n"
      "1 leaves it free, 0.3 lets it make three tenths of every move. With --region it counts "
      "inside.\n"
      "Examples:\n"
      "  burnish smooth scan.ply -o smooth.ply\n"
      "  burnish smooth scan.ply -o smooth.ply --method one_ring_mean:iterations=5 "
      "--region sphere:0,0,0.3,5cm\n"
      "  burnish smooth scan.ply -o smooth.ply --method gaussian:iterations=5 --bound noise:c=2\n"
      "  burnish smooth scan.ply -o smooth.ply --method nearest_farthest:iterations=2");
  return [options](const Session& s, const Context& c) { return smooth(*options, s, c); };
}

}  // namespace burnish::app
