#include <fmt/format.h>

#include "../summary.h"
#include "../verb.h"
#include "burnish/io/geometry_file.h"
#include "burnish/pipeline/phases.h"

namespace burnish::app {
namespace {

struct Options {
  std::string input, output;
  std::vector<std::string> methods{"global"};
};

Result<void> triangulate(const Options& options, const Session& session, const Context& context) {
  const Result<std::vector<Method>> methods = parse_methods(options.methods);
  if (!methods) return methods.error();
  if (auto possible = check_output(options.output); !possible) return possible;
  context.stage("reading " + options.input);
  Result<GeometryFile> file = read_geometry(options.input, context.part(0, 0.2));
  if (!file) return std::move(file).error();

  Record record = new_record("Triangulation of " + options.input, session.command, {options.input});
  keep_notes(options.input, *file, record);
  const Result<TriangleMesh> mesh = triangulate_cloud(cloud_of(*std::move(file)), methods->back(),
                                                      record, context.part(0.2, 0.9));
  if (!mesh) return mesh.error();
  if (auto written = save(options.output, *mesh, session, context.part(0.9, 1)); !written)
    return written;
  say_steps(session, record);
  return {};
}

}  // namespace

Action add_triangulate(CLI::App& app) {
  auto* verb = app.add_subcommand("triangulate", "Make a mesh through the points of a cloud.");
  auto options = std::make_shared<Options>();
  verb->add_option("IN", options->input, "the cloud: PLY, PCD, XYZ, or the vertices of a mesh")
      ->required();
  verb->add_option("-o,--output", options->output, "the file to write; its ending names the format")
      ->required();
  add_method(verb, "-m,--method", options->methods, "triangulate", "how; default: global")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  verb->footer("Methods:\n" + methods_help("triangulate") +
               "Example:\n  burnish triangulate cloud.ply -o mesh.ply --method global");
  return [options](const Session& s, const Context& c) { return triangulate(*options, s, c); };
}

}  // namespace burnish::app
