#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "../verb.h"
#include "burnish/io/geometry_file.h"
#include "burnish/measure/noise_certificate.h"

namespace burnish::app {
namespace {

struct Options {
  std::string before, after;
  double c = 2;
  bool json = false;
};

void print_json(const Options& options, const NoiseCertificate& certificate) {
  nlohmann::ordered_json json{
      {"before", options.before}, {"after", options.after}, {"holds", certificate.holds()}};
  for (const Fact& fact : certificate.facts()) {
    json[fact.unit.empty() ? fact.key : fact.key + "_" + fact.unit] = fact.value;
  }
  json["not_covered"] = kNotCovered;
  fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

Result<void> verify(const Options& options, const Session& session, const Context& context) {
  context.stage("reading " + options.before);
  const Result<GeometryFile> before = read_geometry(options.before, context.part(0, 0.45));
  if (!before) return before.error();
  context.stage("reading " + options.after);
  const Result<GeometryFile> after = read_geometry(options.after, context.part(0.45, 0.9));
  if (!after) return after.error();
  const Result<NoiseCertificate> certificate =
      certify_noise_bound(before->mesh, after->mesh, options.c);
  if (!certificate) {
    return Error{certificate.error().code, certificate.error().text(),
                 options.before + ", " + options.after};
  }
  const std::vector<std::string> lines = sentences(*certificate);
  if (options.json) print_json(options, *certificate);
  if (!certificate->holds()) return Error{ErrorCode::refuted, lines.front(), options.after};
  if (!options.json) {
    for (const std::string& line : lines) say(session, line);
  }
  return {};
}

}  // namespace

Action add_verify(CLI::App& app) {
  auto* verb = app.add_subcommand(
      "verify", "Check that a smoothing stayed within the noise of what it was given.");
  auto options = std::make_shared<Options>();
  verb->add_option("BEFORE", options->before,
                   "the mesh that was smoothed, with noise or sigma of every vertex")
      ->required();
  verb->add_option("AFTER", options->after, "what came of it, vertex for vertex")->required();
  verb->add_option("--c", options->c, "standard deviations that a vertex may have moved")
      ->capture_default_str();
  verb->add_flag("--json", options->json, "print as JSON");
  verb->footer(
      "Computes every displacement anew, from the two files alone, and shares nothing with what\n"
      "bounds a smoothing. Ends with 0 and the certificate where no vertex is farther than c\n"
      "standard deviations from where it was; with 9, naming the vertex that is the farthest, "
      "where "
      "one is.\n"
      "Example:\n"
      "  burnish smooth scan.ply -o smooth.ply --method gaussian:iterations=5 --bound noise:c=2\n"
      "  burnish verify scan.ply smooth.ply --c 2");
  return [options](const Session& s, const Context& c) { return verify(*options, s, c); };
}

}  // namespace burnish::app
