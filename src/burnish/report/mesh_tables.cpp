#include "burnish/report/mesh_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "burnish/core/topology.h"
#include "burnish/measure/angle_between.h"
#include "burnish/measure/area_and_volume.h"
#include "burnish/measure/triangle_quality.h"
#include "burnish/report/numbers.h"

namespace burnish {
namespace {

std::vector<std::string> phase_names(const Record& record) {
  std::vector<std::string> names;
  for (const Phase& phase : record.phases) names.push_back(phase.name);
  return names;
}

/// The topology of every phase; it follows from the triangles alone, which smoothing leaves as they
/// are.
std::vector<Topology> topologies(const Record& record) {
  std::vector<Topology> result;
  for (std::size_t i = 0; i < record.phases.size(); ++i) {
    const TriangleMesh& mesh = record.phases[i].mesh;
    const bool same = i > 0 && mesh.triangles == record.phases[i - 1].mesh.triangles &&
                      mesh.positions.size() == record.phases[i - 1].mesh.positions.size();
    result.push_back(same ? result.back() : topology(mesh));
  }
  return result;
}

/// Width, depth and height of the box around all triangles; area and volume.
Facts size_facts(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return {};
  constexpr double kMost = std::numeric_limits<double>::max();
  Vec3d low{kMost, kMost, kMost}, high = -low;
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double x = mesh.positions[v][axis];
        low[axis] = std::min(low[axis], x), high[axis] = std::max(high[axis], x);
      }
    }
  }
  const Vec3d size = high - low;
  Facts facts{{"extent_x", size.x, "m"}, {"extent_y", size.y, "m"}, {"extent_z", size.z, "m"}};
  if (const auto measured = area_and_volume(mesh)) {
    for (Fact& fact : measured->facts()) facts.push_back(std::move(fact));
  }
  return facts;
}

/// The value below which `share` of the values lie; NaN where there are none.
template <class T>
double value_at(std::vector<T>& values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto rank = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), at, values.end());
  return static_cast<double>(*at);
}

double angle_at(const Vec3d& corner, const Vec3d& a, const Vec3d& b) {
  return angle_between(a - corner, b - corner) * 180 / std::numbers::pi;
}

/// How many triangles close a hole, and how much of the surface they are.
void add_invented_triangles(const TriangleMesh& mesh, Facts& facts) {
  const std::vector<Origin>& origin = mesh.triangle_attributes.origin;
  if (origin.empty()) return;
  double count = 0, area = 0;
  for (std::size_t t = 0; t < origin.size(); ++t) {
    if (origin[t] != Origin::invented) continue;
    ++count;
    area += norm(area_vector(mesh, t)) / 2;
  }
  facts.push_back({"invented_triangles", count, ""});
  facts.push_back({"invented_area", area, "m2"});
}

}  // namespace

Table topology_table(const Record& record) {
  Table table{"Size and topology", phase_names(record), {}};
  const std::vector<Topology> all = topologies(record);
  const auto count = [&](const char* title, auto value, bool should_be_zero = false) {
    Table::Row row{title, {}, {}};
    for (const Topology& one : all) {
      row.cells.push_back(number_text(static_cast<double>(value(one))));
      row.wrong.push_back(should_be_zero && value(one) != 0);
    }
    table.rows.push_back(std::move(row));
  };
  Table::Row vertices{"Vertices", {}, {}}, triangles{"Triangles", {}, {}};
  for (const Phase& phase : record.phases) {
    vertices.cells.push_back(count_text(phase.mesh.positions.size()));
    triangles.cells.push_back(count_text(phase.mesh.triangles.size()));
  }
  table.rows.push_back(std::move(vertices));
  table.rows.push_back(std::move(triangles));
  std::vector<Facts> sizes;
  for (const Phase& phase : record.phases) sizes.push_back(size_facts(phase.mesh));
  for (Table::Row& row : rows_of(sizes)) table.rows.push_back(std::move(row));

  using T = Topology;
  count("Components", [](const T& t) { return t.components; });
  count("Boundary loops", [](const T& t) { return t.boundary_loops; });
  count("Boundary edges", [](const T& t) { return t.boundary_edges; });
  count("Euler number", [](const T& t) { return t.euler_number; });
  count(
      "Non-manifold edges", [](const T& t) { return t.non_manifold_edges; }, true);
  count(
      "Non-manifold vertices", [](const T& t) { return t.non_manifold_vertices; }, true);
  count(
      "Edges where orientations disagree", [](const T& t) { return t.flipped_edges; }, true);
  count(
      "Degenerate triangles", [](const T& t) { return t.degenerate_triangles; }, true);
  count(
      "Duplicate triangles", [](const T& t) { return t.duplicate_triangles; }, true);
  count("Vertices in no triangle", [](const T& t) { return t.unused_vertices; });
  return table;
}

Table trust_table(const Record& record) {
  Table table{"How far to trust vertices and triangles", phase_names(record), {}};
  std::vector<Facts> facts;
  for (const Phase& phase : record.phases) {
    const Attributes& attributes = phase.mesh.attributes;
    Facts known;
    if (!attributes.origin.empty()) {
      std::array<double, 3> counts{};
      for (const Origin origin : attributes.origin)
        ++counts[std::min<std::size_t>(static_cast<std::size_t>(origin), 2)];
      known.push_back({"seen", counts[0], ""});
      known.push_back({"interpolated", counts[1], ""});
      known.push_back({"invented", counts[2], ""});
    }
    if (!attributes.sigma.empty()) {
      std::vector<float> sigma = attributes.sigma;
      known.push_back({"median_sigma", value_at(sigma, 0.5), "m"});
      known.push_back({"largest_5_%_of_sigma_from", value_at(sigma, 0.95), "m"});
    }
    if (!attributes.observations.empty()) {
      std::vector<std::uint32_t> observations = attributes.observations;
      known.push_back({"median_observations", value_at(observations, 0.5), ""});
    }
    add_invented_triangles(phase.mesh, known);
    facts.push_back(std::move(known));
  }
  table.rows = rows_of(facts);
  return table;
}

TriangleShapes triangle_shapes(const TriangleMesh& mesh) {
  TriangleShapes shapes;
  shapes.angles.reserve(3 * mesh.triangles.size());
  shapes.edges.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const bool flat = squared_norm(area_vector(mesh, t)) == 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Triangle& corners = mesh.triangles[t];
      const Vec3d p(mesh.positions[corners[k]]), q(mesh.positions[corners[(k + 1) % 3]]),
          r(mesh.positions[corners[(k + 2) % 3]]);
      shapes.edges.push_back(static_cast<float>(norm(q - p)));
      if (!flat) shapes.angles.push_back(static_cast<float>(angle_at(p, q, r)));
    }
  }
  return shapes;
}

Result<Table> quality_table(const Record& record, const Context& context) {
  Table table{"Shapes of the triangles", phase_names(record), {}};
  std::vector<Facts> facts;
  for (const Phase& phase : record.phases) {
    if (phase.mesh.triangles.empty()) {
      facts.emplace_back();
      continue;
    }
    const auto quality = triangle_quality(phase.mesh, context.part(1, 1));
    if (!quality) return Error{quality.error().code, quality.error().message, phase.name};
    Facts found = quality->facts();
    std::erase_if(found, [](const Fact& fact) { return fact.key == "triangles"; });
    facts.push_back(std::move(found));
  }
  table.rows = rows_of(facts);
  return table;
}

}  // namespace burnish
