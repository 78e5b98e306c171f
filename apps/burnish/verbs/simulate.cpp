#include <fmt/format.h>

#include <filesystem>

#include "../frame_options.h"
#include "../verb.h"
#include "burnish/io/geometry_file.h"
#include "burnish/sensor/turntable.h"
#include "burnish/shapes/shapes.h"

namespace burnish::app {
namespace {

struct Options {
  std::string model, folder, sensor = "kinect_v1";
  Settings settings;
};

Result<TriangleMesh> model_of(const std::string& name, const Context& context) {
  std::error_code unreadable;
  if (std::filesystem::is_regular_file(name, unreadable)) return read_mesh(name, context);
  Result<TriangleMesh> shape = make_shape(name);
  if (shape) return shape;
  return Error{ErrorCode::not_found,
               fmt::format("neither a file nor a shape ({})", fmt::join(shape_names(), ", ")),
               name};
}

Result<void> simulate(const Options& options, const Session& session, const Context& context) {
  const Result<TurntableParams> params = TurntableParams::schema().parse(options.settings);
  if (!params) return params.error();
  const Result<Sensor> sensor = find_sensor(options.sensor);
  if (!sensor) return sensor.error();
  const Result<TriangleMesh> model = model_of(options.model, context.part(0, 0.1));
  if (!model) return model.error();
  context.stage(fmt::format("scanning {} with a virtual {}", options.model, sensor->name));
  const Result<Simulation> simulation =
      simulate_turntable(*model, *sensor, *params, options.folder, context.part(0.1, 1));
  if (!simulation) return simulation.error();
  for (const Fact& fact : simulation->facts())
    say(session, fmt::format("{}: {}", fact.key, readable(fact)));
  say(session,
      fmt::format("{}: frames with poses; truth/model.ply is the true surface", options.folder));
  return {};
}

}  // namespace

Action add_simulate(CLI::App& app) {
  auto* verb =
      app.add_subcommand("simulate", "Scan a model on a turntable with a virtual depth camera.");
  auto options = std::make_shared<Options>();
  verb->add_option("MODEL", options->model,
                   fmt::format("a mesh file, or a shape: {}", fmt::join(shape_names(), ", ")))
      ->required();
  verb->add_option("-o,--output", options->folder,
                   "the folder to write; new, empty, or an earlier simulation")
      ->required();
  verb->add_option("--sensor", options->sensor, "which camera: " + sensor_names())
      ->capture_default_str();
  add_fields(verb, TurntableParams::schema().fields(), options->settings);
  verb->footer(
      "Example:\n  burnish simulate teapot -o scan --views 24 --sensor kinect_v1 --seed 1 "
      "--distance 0.8m");
  return [options](const Session& s, const Context& c) { return simulate(*options, s, c); };
}

}  // namespace burnish::app
