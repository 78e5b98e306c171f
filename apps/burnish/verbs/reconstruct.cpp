#include <fmt/format.h>

#include "../frame_options.h"
#include "../registration_options.h"
#include "../report_output.h"
#include "../summary.h"
#include "../verb.h"
#include "burnish/io/geometry_file.h"
#include "burnish/pipeline/phases.h"
#include "burnish/pipeline/reconstruct.h"

namespace burnish::app {
namespace {

struct Options {
  std::vector<std::string> inputs;
  std::string output, truth, crop, smooth_region, bound;
  ReportOutput report;
  FrameTexts frames;
  RegistrationTexts registration;
  int frames_at_once = FrameSteps{}.frames_at_once;
  std::vector<std::string> average, filter, clean, merge, clean_merged, triangulate, repair, smooth,
      simplify;
};

const std::vector<std::string> kNone{"none"};

Error cannot_leave_out(std::string_view option) {
  return {
      ErrorCode::invalid_argument, fmt::format("{} is a step that cannot be left out", option), {}};
}

/// "none" alone leaves a step out; nothing leaves it at its default.
Result<void> lay_over(std::vector<Method>& step, const std::vector<std::string>& texts) {
  if (texts.empty()) return {};
  Result<std::vector<Method>> methods = parse_methods(texts);
  if (!methods) return std::move(methods).error();
  step = texts == kNone ? std::vector<Method>{} : *std::move(methods);
  return {};
}

Result<Recipe> recipe_of(const Options& options) {
  Recipe recipe;
  const Result<std::optional<Region>> crop = parse_region_option(options.crop, "--crop");
  if (!crop) return crop.error();
  recipe.crop = *crop;
  const auto smooth_region = parse_region_option(options.smooth_region, "--smooth_region");
  if (!smooth_region) return smooth_region.error();
  recipe.smooth_region = *smooth_region;
  const auto bound = bound_of(options.bound);
  if (!bound) return bound.error();
  recipe.bound = *bound;
  std::vector<Method> average, merge{recipe.merge}, triangulate;
  const std::pair<std::vector<Method>*, const std::vector<std::string>*> steps[] = {
      {&average, &options.average},
      {&recipe.frames.filter, &options.filter},
      {&recipe.clean_scan, &options.clean},
      {&merge, &options.merge},
      {&recipe.clean_merged, &options.clean_merged},
      {&triangulate, &options.triangulate},
      {&recipe.repair, &options.repair},
      {&recipe.smooth, &options.smooth},
      {&recipe.simplify, &options.simplify}};
  for (const auto& [step, texts] : steps) {
    if (auto laid = lay_over(*step, *texts); !laid) return laid.error();
  }
  if (merge.empty()) return cannot_leave_out("--merge");
  if (options.triangulate == kNone) return cannot_leave_out("--triangulate");
  if (!average.empty()) recipe.frames.average = average.back();
  recipe.frames.frames_at_once = options.frames_at_once;
  recipe.merge = merge.back();
  if (!triangulate.empty()) recipe.triangulate = triangulate.back();
  return recipe;
}

Result<void> run(const Options& options, const Session& session, const Context& context) {
  if (auto possible = check_output(options.output); !possible) return possible;
  if (auto possible = check_report_output(options.report); !possible) return possible;
  const Result<Recipe> recipe = recipe_of(options);
  if (!recipe) return recipe.error();
  Result<FrameOptions> frames = read_frame_texts(options.frames);
  if (!frames) return std::move(frames).error();
  const auto registration = read_registration_texts(options.registration);
  if (!registration) return registration.error();
  ScanInputs inputs{
      {options.inputs.begin(), options.inputs.end()}, *std::move(frames), *registration};
  ReconstructOptions how;
  if (!options.truth.empty()) how.truth = options.truth;
  how.keep_phases = options.report.wanted();

  Record record =
      new_record("Reconstruction of " + options.inputs.front(), session.command, options.inputs);
  Result<Reconstruction> made =
      reconstruct(inputs, *recipe, how, std::move(record), context.part(0, 0.85));
  if (!made) return std::move(made).error();
  if (auto written = save(options.output, made->mesh, session, context.part(0.85, 0.88),
                          comments_of(made->record));
      !written) {
    return written;
  }
  say_steps(session, made->record);
  say_certificate(session, made->record);
  say_comparisons(session, made->record);
  say_mesh(session, options.output, made->mesh);
  return write_report_output(options.report, made->record, session, context.part(0.88, 1));
}

}  // namespace

Action add_reconstruct(CLI::App& app) {
  auto* verb = app.add_subcommand("reconstruct", "Make a clean mesh from depth frames or clouds.");
  auto options = std::make_shared<Options>();
  verb->add_option("INPUT", options->inputs,
                   "a folder of depth frames or PCD, single depth images (PNG, PGM, TIFF), or "
                   "clouds (PLY, PCD, XYZ)")
      ->required();
  verb->add_option("-o,--output", options->output, "the mesh to write; its ending names the format")
      ->required();
  add_report_options(verb, options->report);
  verb->add_option("--truth", options->truth,
                   "a mesh of the true surface, to compare points and phases with");
  add_frame_options(verb, options->frames);
  add_registration_options(verb, options->registration);
  verb->add_option(
      "--crop", options->crop,
      "keep only what lies in box:x0,y0,z0,x1,y1,z1 or sphere:x,y,z,radius (world, m)");
  add_method(verb, "--average", options->average, "average",
             "make one frame of those that follow each other from one place (equal poses, or none)")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  verb->add_option("--frames_at_once", options->frames_at_once,
                   "at most so many frames become one with --average")
      ->capture_default_str();
  add_method(verb, "--filter", options->filter, "filter", "filter each depth frame");
  add_method(verb, "--clean", options->clean, "clean", "clean each organized scan; none: do not");
  add_method(verb, "--merge", options->merge, "merge",
             "merge several scans; volume makes the surface of depth frames at once, with "
             "signed distances in a grid (burnish list fuse)")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  add_method(verb, "--clean_merged", options->clean_merged, "clean",
             "clean the merged cloud; none: do not");
  add_method(verb, "--triangulate", options->triangulate, "triangulate",
             "make the surface; default: organized for one frame, global otherwise")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  add_method(verb, "--repair", options->repair, "repair", "repair the mesh; none: do not");
  add_method(verb, "--smooth", options->smooth, "smooth",
             "smooth the mesh; default: auto; repeat it for one phase after another; none: do not");
  verb->add_option(
      "--smooth_region", options->smooth_region,
      "smooth only vertices in box:x0,y0,z0,x1,y1,z1 or sphere:x,y,z,radius (world, m)");
  add_bound(verb, options->bound);
  add_method(verb, "--simplify", options->simplify, "simplify",
             "make the mesh smaller last: quadric:ratio=0.1, quadric:max_error=1mm, "
             "quadric:max_sigmas=1; default: do not");
  verb->footer(
      "Known layouts: 7-Scenes (frame-NNN.depth.png, frame-NNN.pose.txt, camera-intrinsics.txt); "
      "numbered\n"
      "images with a list of poses (x y z qx qy qz qw; TUM: timestamp first; Redwood "
      "trajectory.log);\n"
      "organized PCD. Frames without poses are registered first, as burnish register does.\n"
      "Examples:\n"
      "  burnish reconstruct scan/ -o model.ply --report report.html\n"
      "  burnish reconstruct shots/ -o cup.ply --turntable --farthest 1.1m\n"
      "  burnish reconstruct depth.png --sensor kinect_v1 -o person.ply --smooth "
      "nearest_farthest:iterations=3\n"
      "  burnish reconstruct still/ -o desk.ply --sensor primesense --average temporal_mean "
      "--filter bilateral_depth");
  return [options](const Session& s, const Context& c) { return run(*options, s, c); };
}

}  // namespace burnish::app
