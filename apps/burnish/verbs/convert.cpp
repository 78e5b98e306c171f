#include <fmt/format.h>

#include "../summary.h"
#include "../verb.h"
#include "burnish/io/geometry_file.h"

namespace burnish::app {
namespace {

struct Options {
  std::string input, output;
  bool ascii = false;
};

Result<void> convert(const Options& options, const Session& session, const Context& context) {
  if (auto possible = check_output(options.output); !possible) return possible;
  context.stage("reading " + options.input);
  Result<GeometryFile> file = read_geometry(options.input, context.part(0, 0.5));
  if (!file) return std::move(file).error();
  for (const std::string& note : file->notes)
    say(session, fmt::format("{}: {}", options.input, note));
  context.stage("writing " + options.output);
  const WriteOptions how{.ascii = options.ascii, .comments = {}};
  const Result<WriteReport> written =
      file->mesh.triangles.empty()
          ? write_cloud(options.output, cloud_of(*std::move(file)), how, context.part(0.5, 1))
          : write_mesh(options.output, file->mesh, how, context.part(0.5, 1));
  return finish_writing(written, options.output, session);
}

}  // namespace

Action add_convert(CLI::App& app) {
  auto* verb = app.add_subcommand("convert", "Convert a mesh or cloud to another format.");
  auto options = std::make_shared<Options>();
  verb->add_option("IN", options->input, "a mesh or cloud: PLY, OBJ, STL, OFF, PCD, XYZ")
      ->required();
  verb->add_option("OUT", options->output, "the file to write; its ending names the format")
      ->required();
  verb->add_flag("--ascii", options->ascii, "write text where the format has both");
  verb->footer("Example:\n  burnish convert bunny.ply bunny.stl");
  return [options](const Session& s, const Context& c) { return convert(*options, s, c); };
}

}  // namespace burnish::app
