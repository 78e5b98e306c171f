#include <fmt/format.h>

#include "../edit_file.h"
#include "../summary.h"
#include "../verb.h"
#include "burnish/base/quantity.h"
#include "burnish/io/geometry_file.h"
#include "burnish/pipeline/focus_cloud.h"
#include "burnish/pipeline/focus_mesh.h"
#include "burnish/pipeline/phases.h"

namespace burnish::app {
namespace {

struct Options {
  std::string input, output, region, inside_error, outside_error;
  std::size_t outside_triangles = 0, outside_points = 0;
  ReportOutput report;
};

/// A length that is not negative, as `option` was given it.
Result<double> error_of(const std::string& text, const char* option) {
  const Result<double> error = parse_quantity(text, Quantity::length);
  if (!error) return Error{error.error().code, error.error().message, option};
  if (*error >= 0) return *error;
  return Error{ErrorCode::invalid_argument,
               fmt::format("'{}' is negative; a distance was expected", text), option};
}

Result<Focus> focus_of(const Options& options) {
  Focus focus;
  focus.outside_triangles = options.outside_triangles;
  if (!options.inside_error.empty()) {
    const Result<double> error = error_of(options.inside_error, "--inside_error");
    if (!error) return error.error();
    focus.inside_error = *error;
  }
  if (!options.outside_error.empty()) {
    const Result<double> error = error_of(options.outside_error, "--outside_error");
    if (!error) return error.error();
    focus.outside_error = *error;
  }
  return focus;
}

Result<void> adapt_mesh(TriangleMesh mesh, const Options& options, Record& record,
                        const Session& session, const Context& context) {
  const Result<Focus> focus = focus_of(options);
  if (!focus) return focus.error();
  if (options.outside_points > 0) {
    return Error{ErrorCode::invalid_argument,
                 "--outside_points is for clouds, and this is a mesh; --outside_triangles would do",
                 {}};
  }
  const bool keep_phases = options.report.wanted();
  if (keep_phases) record.phases.push_back({"original", mesh, {}});
  if (auto done = focus_mesh(mesh, options.region, *focus, record, context.part(0, 0.8)); !done) {
    return done;
  }
  if (keep_phases) record.phases.push_back({"adapted", mesh, {}});
  return save(options.output, mesh, session, context.part(0.8, 1), comments_of(record));
}

Result<void> adapt_cloud(PointCloud cloud, const Options& options, Record& record,
                         const Session& session, const Context& context) {
  if (!options.inside_error.empty() || !options.outside_error.empty() ||
      options.outside_triangles > 0) {
    return Error{ErrorCode::invalid_argument,
                 "of a cloud only the --outside_points can be bounded, and this is one",
                 {}};
  }
  if (auto done =
          focus_cloud(cloud, options.region, options.outside_points, record, context.part(0, 0.8));
      !done) {
    return done;
  }
  say_methods(session, record);
  return save(options.output, cloud, session, context.part(0.8, 1));
}

Result<void> adapt(const Options& options, const Session& session, const Context& context) {
  const auto run = [&](GeometryFile file, Record& record, const Context& share) {
    return file.mesh.triangles.empty()
               ? adapt_cloud(cloud_of(std::move(file)), options, record, session, share)
               : adapt_mesh(std::move(file.mesh), options, record, session, share);
  };
  return edit_file({"Adaptation of", options.input, options.output, options.report}, run, session,
                   context);
}

}  // namespace

Action add_adapt(CLI::App& app) {
  auto* verb = app.add_subcommand(
      "adapt", "Keep a mesh or cloud fine in a region and make the rest coarse.");
  auto options = std::make_shared<Options>();
  verb->add_option("IN", options->input,
                   "the mesh: PLY, OBJ, STL, OFF; or the cloud: PLY, PCD, XYZ")
      ->required();
  verb->add_option("-o,--output", options->output, "the file to write; its ending names the format")
      ->required();
  verb->add_option("--region", options->region,
                   "where it stays fine: box:x0,y0,z0,x1,y1,z1, sphere:x,y,z,radius or "
                   "near:MESH,distance (world, m)")
      ->required();
  verb->add_option("--outside_triangles", options->outside_triangles,
                   "stop at so many triangles without a corner in the region")
      ->type_name("N");
  verb->add_option("--outside_points", options->outside_points,
                   "of a cloud: so many points stay outside; default: half of them")
      ->type_name("N");
  verb->add_option("--outside_error", options->outside_error,
                   "outside, never farther from the original than this: 1mm");
  verb->add_option(
      "--inside_error", options->inside_error,
      "inside, remove what changes the surface by no more than this; default: nothing");
  add_report_options(verb, options->report);
  verb->footer(
      "Vertices are removed and none is moved. The rest becomes as coarse as it can without harm,\n"
      "or until the number of triangles or the error outside is reached, whichever comes first.\n"
      "Of a cloud, those points outside go that carry least information (burnish list thin).\n"
      "Examples:\n"
      "  burnish adapt scan.ply -o face.ply --region sphere:0,0.1,0.6,8cm --outside_triangles "
      "2000\n"
      "  burnish adapt scan.ply -o part.ply --region near:part.stl,5mm --outside_error 2mm\n"
      "  burnish adapt scan.ply -o part.ply --region near:part.stl,5mm --inside_error 0.1mm");
  return [options](const Session& s, const Context& c) { return adapt(*options, s, c); };
}

}  // namespace burnish::app
