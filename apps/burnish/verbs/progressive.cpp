#include <chrono>

#include "../summary.h"
#include "../verb.h"
#include "burnish/adaptation/point_removal.h"
#include "burnish/io/geometry_file.h"
#include "burnish/pipeline/phases.h"
#include "burnish/pipeline/progressive_file.h"

namespace burnish::app {
namespace {

struct Options {
  std::string input, output;
};

Result<void> check_name(const std::string& path) {
  if (path.ends_with(".bpm")) return check_folder_of(path);
  return Error{ErrorCode::unsupported, "a progressive mesh is written to a file that ends in .bpm",
               path};
}

Result<void> write(const Options& options, const Session& session, const Context& context) {
  if (auto possible = check_name(options.output); !possible) return possible;
  context.stage("reading " + options.input);
  Result<GeometryFile> file = read_geometry(options.input, context.part(0, 0.1));
  if (!file) return std::move(file).error();
  Record record = new_record("", session.command, {options.input});
  keep_notes(options.input, *file, record);
  const Result<TriangleMesh> mesh = mesh_of(*std::move(file), options.input);
  if (!mesh) return mesh.error();

  const auto start = std::chrono::steady_clock::now();
  context.stage("removing vertices");
  const auto removals = removal_log(*mesh, 0, context.part(0.1, 0.8));
  if (!removals) return removals.error();
  context.stage("writing " + options.output);
  const auto report = write_progressive(options.output, *mesh, *removals, context.part(0.8, 1));
  if (!report) return report.error();
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  record.steps.push_back({"progressive", "point_removal", {}, report->facts(), spent.count(), {}});
  say_steps(session, record);
  return {};
}

}  // namespace

Action add_progressive(CLI::App& app) {
  auto* verb =
      app.add_subcommand("progressive", "Write a mesh at every level of detail into one file.");
  auto options = std::make_shared<Options>();
  verb->add_option("IN", options->input, "the mesh: PLY, OBJ, STL, OFF")->required();
  verb->add_option("-o,--output", options->output, "the file to write: FILE.bpm")->required();
  verb->footer(
      "The file holds a coarse mesh and a record for every vertex that was removed from the\n"
      "original, so that `burnish extract` gives any level between the two, and the original to\n"
      "the last bit, with all that is known of its vertices and triangles. It is smaller than a\n"
      "binary PLY. A beginning of it, up to the end of any record, is a file of a coarser mesh.\n"
      "Example:\n"
      "  burnish progressive scan.ply -o scan.bpm");
  return [options](const Session& s, const Context& c) { return write(*options, s, c); };
}

}  // namespace burnish::app
