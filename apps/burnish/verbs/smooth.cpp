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

  if (auto possible = check_output(options.output); !possible) return possible;
  if (auto possible = check_report_output(options.report); !possible) return possible;
  context.stage("reading " + options.input);
  Result<GeometryFile> file = read_geometry(options.input, context.part(0, 0.2));
  if (!file) return std::move(file).error();

  Record record = new_record("Smoothing of " + options.input, session.command, {options.input});
  keep_notes(options.input, *file, record);
  Result<TriangleMesh> mesh = mesh_of(*std::move(file), options.input);
  if (!mesh) return std::move(mesh).error();
  const bool keep_phases = options.report.wanted();
  if (auto done = smooth_in_phases(*mesh, *methods, {*region, *bound}, keep_phases, record,
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
  say_certificate(session, record);
  return write_report_output(options.report, record, session, context.part(0.8, 1));
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
