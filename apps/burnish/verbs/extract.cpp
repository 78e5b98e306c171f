#include <fmt/format.h>

#include <chrono>

#include "../summary.h"
#include "../verb.h"
#include "burnish/base/quantity.h"
#include "burnish/pipeline/focus_mesh.h"
#include "burnish/pipeline/phases.h"
#include "burnish/pipeline/progressive_file.h"

namespace burnish::app {
namespace {

struct Options {
  std::string input, output, error, region;
  std::optional<std::uint64_t> triangles, outside_triangles;
};

/// How far to read, as far as the options say.
Result<ProgressiveStop> stop_of(const Options& options) {
  const auto refuse = [](const char* why) { return Error{ErrorCode::invalid_argument, why, {}}; };
  if (options.triangles && !options.error.empty())
    return refuse("--triangles and --error exclude each other");
  if (options.triangles && !options.region.empty())
    return refuse("with --region the triangles outside are counted: --outside_triangles");
  if (options.outside_triangles && options.region.empty())
    return refuse("--outside_triangles needs a --region");
  ProgressiveStop stop{options.triangles, {}};
  if (options.error.empty()) return stop;
  const Result<double> error = parse_quantity(options.error, Quantity::length);
  if (!error) return error.error();
  if (!(*error >= 0)) return refuse("--error must not be negative");
  stop.error = *error;
  return stop;
}

Facts facts_of(const ProgressiveLevel& level) {
  return {{"vertices", static_cast<double>(level.mesh.positions.size()), ""},
          {"triangles", static_cast<double>(level.mesh.triangles.size()), ""},
          {"of_triangles", static_cast<double>(level.file.triangles), ""},
          {"error_bound", level.error, "m"},
          {"bytes_read", static_cast<double>(level.bytes_read), ""},
          {"of_bytes", static_cast<double>(level.file.bytes), ""}};
}

/// The level that is to be written; the record gets how it came about.
Result<TriangleMesh> extract(const Options& options, const ProgressiveStop& stop, Record& record,
                             const Context& context) {
  const auto start = std::chrono::steady_clock::now();
  context.stage("reading " + options.input);
  auto content = [&]() -> Result<ProgressiveContent> {
    if (!options.region.empty()) return read_progressive_all(options.input, context.part(0, 0.4));
    auto level = read_progressive(options.input, stop, context);
    if (!level) return level.error();
    return ProgressiveContent{*std::move(level), {}};
  }();
  if (!content) return std::move(content).error();
  auto& [level, removals] = *content;
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  record.steps.push_back({"extract", "level", {}, facts_of(level), spent.count(), {}});
  for (const std::string& note : level.notes)
    record.notes.push_back(fmt::format("{}: {}", options.input, note));
  if (options.region.empty()) return std::move(level.mesh);
  Focus focus;
  focus.inside_error = stop.error;
  focus.outside_triangles = options.outside_triangles.value_or(0);
  if (auto done =
          focus_mesh(level.mesh, removals, options.region, focus, record, context.part(0.4, 1));
      !done) {
    return done.error();
  }
  return std::move(level.mesh);
}

Result<void> run(const Options& options, const Session& session, const Context& context) {
  const Result<ProgressiveStop> stop = stop_of(options);
  if (!stop) return stop.error();
  if (auto possible = check_output(options.output); !possible) return possible;
  Record record = new_record("", session.command, {options.input});
  const auto mesh = extract(options, *stop, record, context.part(0, 0.7));
  if (!mesh) return mesh.error();
  if (auto written = save(options.output, *mesh, session, context.part(0.7, 1)); !written)
    return written;
  say_steps(session, record);
  return {};
}

}  // namespace

Action add_extract(CLI::App& app) {
  auto* verb = app.add_subcommand("extract", "Take a level of detail out of a progressive file.");
  auto options = std::make_shared<Options>();
  verb->add_option("FILE", options->input, "what `burnish progressive` wrote: FILE.bpm")
      ->required();
  verb->add_option("-o,--output", options->output, "the file to write; its ending names the format")
      ->required();
  verb->add_option("--triangles", options->triangles, "the finest level of at most so many")
      ->check(CLI::NonNegativeNumber)
      ->type_name("N");
  verb->add_option("--error", options->error,
                   "the coarsest level that is as near to the original: 1mm")
      ->type_name("E");
  verb->add_option("--region", options->region,
                   "fine only in box:x0,y0,z0,x1,y1,z1 or sphere:x,y,z,radius (world, m) or "
                   "near:MESH,distance; --error then counts inside");
  verb->add_option("--outside_triangles", options->outside_triangles,
                   "so coarse outside the region that at most so many triangles have no corner "
                   "inside; default: as coarse as it goes")
      ->check(CLI::NonNegativeNumber)
      ->type_name("M");
  verb->footer(
      "Without --triangles, --error and --region: the original, to the last bit. A level is read "
      "in "
      "time and\n"
      "memory in proportion to it; a region needs the whole file. A file that was cut short at the "
      "end of a\n"
      "record gives the levels that are in it; a damaged one is refused, with the place and with "
      "what can be had.\n"
      "Examples:\n"
      "  burnish extract scan.bpm -o small.ply --triangles 10000\n"
      "  burnish extract scan.bpm -o near.ply --error 1mm\n"
      "  burnish extract scan.bpm -o face.ply --region sphere:0,0.1,0.4,8cm --outside_triangles "
      "2000");
  return [options](const Session& s, const Context& c) { return run(*options, s, c); };
}

}  // namespace burnish::app
