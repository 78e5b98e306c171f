#include "conformance/exceptions.h"

namespace burnish::test {

std::span<const Exception> exceptions() {
  static const std::vector<Exception> table{
      {"triangulate/fan_cloud", "turned by a quarter",
       "fans are chosen in an order along the axes"},
      {"triangulate/fan_cloud", "rotated", "fans are chosen in an order along the axes"},
      {"triangulate/global", "turned by a quarter", "triangles come in an order along the axes"},
      {"triangulate/global", "rotated", "triangles come in an order along the axes"},
      {"triangulate/delaunay", "rotated",
       "rounding four points nearly on a circle may swap a diagonal"},
      {"smooth/guided_normal", "turned by a quarter",
       "two patches may be of one piece alike but for the last bits"},
      {"smooth/auto", "turned by a quarter",
       "surroundings may lean to neither side but for the last bits"},
      {"simplify/point_removal", "turned by a quarter",
       "rounding decides which edges a round takes"},
      {"simplify/point_removal", "rotated", "rounding decides which edges a round takes"},
      {"simplify/quadric", "relabelled",
       "sums go around a vertex from the first of its triangles, and their last bits choose"},
      {"simplify/quadric", "turned by a quarter",
       "rounding decides which of two equally cheap edges goes"},
      {"simplify/quadric", "rotated", "rounding decides which of two equally cheap edges goes"},
      {"refine/split", "rotated", "edges of nearly one length may change places in the order"},
      {"merge/cells", "turned by a quarter", "its cells are columns along the axes"},
      {"merge/cells", "rotated", "its cells are columns along the axes"},
  };
  return table;
}

namespace {

/// Two wedges, each of two sheets, that share an edge and nothing else.
void touch_in_an_edge(Workpiece& sample) {
  sample.mesh = {};
  sample.mesh.positions = {{0, 0, 0}, {0, 0, 1}, {1, 1, 0}, {1, -1, 0}, {-1, 1, 0}, {-1, -1, 0}};
  sample.mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 5}, {1, 0, 4}};
}

}  // namespace

std::string_view exception(std::string_view operation, std::string_view property) {
  for (const Exception& entry : exceptions()) {
    if (entry.operation == operation && entry.property == property) return entry.reason;
  }
  return {};
}

Companion companion(std::string_view operation, std::string_view field) {
  static const std::vector<Companion> table{
      {"thin/fan_cloud", "distance_weight", {{"noise_sigmas", "0"}}, {}},
      {"repair/manifold", "keep_solids", {}, touch_in_an_edge},
      {"triangulate/fan_cloud",
       "steep_angle",
       {},
       [](Workpiece& sample) { sample.clouds.front().attributes.normals.clear(); }},
      {"triangulate/organized",
       "assumed_noise",
       {},
       [](Workpiece& sample) { sample.clouds.front().attributes.sigma.clear(); }},
  };
  for (const Companion& entry : table) {
    if (entry.operation == operation && entry.field == field) return entry;
  }
  return {};
}

}  // namespace burnish::test
