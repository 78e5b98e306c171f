#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "../verb.h"
#include "burnish/base/quantity.h"
#include "burnish/core/topology.h"
#include "burnish/io/geometry_file.h"
#include "burnish/measure/area_and_volume.h"
#include "burnish/measure/denoising_error.h"
#include "burnish/measure/noise_estimate.h"
#include "burnish/measure/one_ring_table.h"
#include "burnish/measure/surface_coverage.h"
#include "burnish/measure/triangle_quality.h"
#include "burnish/measure/truth.h"

namespace burnish::app {
namespace {

struct Options {
  std::string input, truth, spacing;
  std::optional<std::uint32_t> vertex;
  bool json = false;
};

using Section = std::pair<std::string, Facts>;

Facts topology_facts(const TriangleMesh& mesh) {
  const Topology t = topology(mesh);
  const auto fact = [](const char* key, auto value) {
    return Fact{key, static_cast<double>(value), ""};
  };
  return {fact("vertices", mesh.positions.size()),
          fact("triangles", mesh.triangles.size()),
          fact("edges", t.edges),
          fact("components", t.components),
          fact("euler_number", t.euler_number),
          fact("boundary_loops", t.boundary_loops),
          fact("boundary_edges", t.boundary_edges),
          fact("non_manifold_edges", t.non_manifold_edges),
          fact("non_manifold_vertices", t.non_manifold_vertices),
          fact("flipped_edges", t.flipped_edges),
          fact("degenerate_triangles", t.degenerate_triangles),
          fact("duplicate_triangles", t.duplicate_triangles),
          fact("unused_vertices", t.unused_vertices)};
}

void print_ring(const OneRingTable& table) {
  constexpr double kDegrees = 180 / std::numbers::pi;
  fmt::print("one-ring of vertex {} at {:.9g} {:.9g} {:.9g}\n", table.vertex, table.position.x,
             table.position.y, table.position.z);
  fmt::print("{:>10} {:>14} {:>14} {:>14} {:>14} {:>14}\n", "vertex", "x", "y", "z", "distance",
             "|mean - d|");
  for (const auto& n : table.neighbours) {
    fmt::print("{:>10} {:>14.9g} {:>14.9g} {:>14.9g} {:>14.9g} {:>14.9g}\n", n.vertex, n.position.x,
               n.position.y, n.position.z, n.distance, n.deviation);
  }
  for (const auto& c : table.corners)
    fmt::print("angle {}-{}-{}: {:.4f} deg\n", c.from, table.vertex, c.to, c.angle * kDegrees);
}

/// Adds what the true surface tells.
Result<void> compare(const Options& options, const TriangleMesh& mesh,
                     std::vector<Section>& sections, const Context& context) {
  CoverageParams params;
  if (!options.spacing.empty()) {
    const Result<double> spacing = parse_quantity(options.spacing, Quantity::length);
    if (!spacing) return Error{spacing.error().code, spacing.error().message, "--spacing"};
    params.spacing = *spacing;
  }
  context.stage("comparing with " + options.truth);
  const Result<TriangleMesh> truth = read_mesh(options.truth, context.part(0, 0.1));
  if (!truth) return truth.error();
  const auto comparison = compare_to_truth(mesh, *truth, {}, context.part(0.1, 0.5));
  if (!comparison) return comparison.error();
  sections.emplace_back("truth", comparison->facts());
  const auto coverage = surface_coverage(mesh, *truth, params, context.part(0.5, 0.9));
  if (!coverage) return coverage.error();
  sections.emplace_back("coverage", coverage->facts());
  if (!correspond(mesh, *truth)) return {};
  const auto denoising = compare_denoised(mesh, *truth, context.part(0.9, 1));
  if (!denoising) return denoising.error();
  sections.emplace_back("denoising", denoising->facts());
  return {};
}

Result<std::vector<Section>> measure_all(const Options& options, const TriangleMesh& mesh,
                                         const Context& context) {
  std::vector<Section> sections{{"topology", topology_facts(mesh)}};
  const Result<TriangleQuality> quality = triangle_quality(mesh, context.part(0, 0.3));
  if (!quality) return quality.error();
  sections.emplace_back("quality", quality->facts());
  const Result<AreaAndVolume> size = area_and_volume(mesh);
  if (!size) return size.error();
  sections.emplace_back("size", size->facts());
  const Result<NoiseEstimate> noise = estimate_noise(mesh);
  if (!noise) return noise.error();
  sections.emplace_back("noise", noise->facts());
  if (!options.truth.empty()) {
    if (auto added = compare(options, mesh, sections, context.part(0.4, 1)); !added) {
      return added.error();
    }
  }
  return sections;
}

void print_sections(const std::vector<Section>& sections) {
  for (const auto& [name, facts] : sections) {
    fmt::print("{}\n", name);
    for (const Fact& fact : facts) fmt::print("  {:<28} {}\n", fact.key, readable(fact));
  }
}

void print_json(const std::string& file, const std::vector<Section>& sections) {
  nlohmann::ordered_json json{{"file", file}};
  for (const auto& [name, facts] : sections) {
    for (const Fact& fact : facts) {
      json[name][fact.unit.empty() ? fact.key : fact.key + "_" + fact.unit] = fact.value;
    }
  }
  fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

Result<void> measure(const Options& options, const Context& context) {
  context.stage("reading " + options.input);
  const Result<TriangleMesh> mesh = read_mesh(options.input, context.part(0, 0.2));
  if (!mesh) return mesh.error();
  context.stage("measuring " + options.input);
  if (options.vertex) {
    const Result<OneRingTable> table = one_ring_table(*mesh, *options.vertex);
    if (!table) return table.error();
    if (options.json) {
      print_json(options.input, {{"one_ring", table->facts()}});
    } else {
      print_ring(*table);
      print_sections({{"one_ring", table->facts()}});
    }
    return {};
  }
  const Result<std::vector<Section>> sections = measure_all(options, *mesh, context.part(0.2, 1));
  if (!sections) return sections.error();
  if (options.json) {
    print_json(options.input, *sections);
  } else {
    print_sections(*sections);
  }
  return {};
}

}  // namespace

Action add_measure(CLI::App& app) {
  auto* verb = app.add_subcommand(
      "measure",
      "Measure a mesh: topology, triangle quality, size, noise, truth, coverage, denoising.");
  auto options = std::make_shared<Options>();
  verb->add_option("IN", options->input, "the mesh: PLY, OBJ, STL, OFF")->required();
  auto* truth =
      verb->add_option("--truth", options->truth,
                       "a mesh of the true surface to compare with; where its triangles are those "
                       "of IN, also what smoothing left of the noise (denoising)");
  verb->add_option(
          "--spacing", options->spacing,
          "how far the points are from each other, for what is missing (farther than 1 "
          "spacing) and invented (farther than 2); default: from the area and the vertices")
      ->type_name("LENGTH")
      ->needs(truth);
  verb->add_option("--vertex", options->vertex,
                   "print the one-ring of this vertex instead: distances, deviations, angles")
      ->type_name("N");
  verb->add_flag("--json", options->json, "print JSON, in m and rad");
  verb->footer(
      "denoising compares triangle with triangle: normal_error is E_a, the mean angle between the "
      "normals;\n"
      "vertex_error is E_v, the area-weighted RMS distance of the vertices from the truth, also in "
      "its mean\n"
      "edges and in thousandths of its diagonal; flipped triangles are turned by more than 90 "
      "degrees.\n"
      "Example:\n  burnish measure model.ply --truth true.ply --json");
  return [options](const Session&, const Context& c) { return measure(*options, c); };
}

}  // namespace burnish::app
