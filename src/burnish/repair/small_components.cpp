#include "burnish/repair/small_components.h"

#include <algorithm>

#include "burnish/core/topology.h"

namespace burnish {

const Schema<SmallComponentsParams>& SmallComponentsParams::schema() {
  using P = SmallComponentsParams;
  static const auto schema =
      Schema<P>()
          .integer("min_triangles", &P::min_triangles, at_least(0),
                   "a component with fewer triangles goes")
          .flag("largest_only", &P::largest_only, "keep nothing but the largest component");
  return schema;
}

Facts RepairReport::facts() const {
  return {{"components", static_cast<double>(components), ""},
          {"removed_components", static_cast<double>(removed_components), ""},
          {"removed_triangles", static_cast<double>(removed_triangles), ""},
          {"removed_vertices", static_cast<double>(removed_vertices), ""}};
}

Result<RepairReport> remove_small_components(TriangleMesh& mesh,
                                             const SmallComponentsParams& params,
                                             const Context& context) {
  if (auto valid = SmallComponentsParams::schema().check(params); !valid) return valid.error();
  if (auto sound = check(mesh); !sound) return sound.error();

  const std::vector<std::uint32_t> component = triangle_components(mesh);
  if (context.cancelled()) return cancelled();
  std::vector<int> sizes;
  for (const std::uint32_t c : component) {
    if (c >= sizes.size()) sizes.resize(c + 1);
    ++sizes[c];
  }
  const auto largest = std::max_element(sizes.begin(), sizes.end());
  std::vector<bool> kept(sizes.size());
  for (std::size_t c = 0; c < sizes.size(); ++c) {
    const bool is_largest = sizes.begin() + static_cast<std::ptrdiff_t>(c) == largest;
    kept[c] = is_largest || (sizes[c] >= params.min_triangles && !params.largest_only);
  }

  context.progress(0.5);
  if (context.cancelled()) return cancelled();

  std::vector<std::uint32_t> kept_triangles;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (kept[component[t]]) kept_triangles.push_back(t);
  }
  TriangleMesh result = mesh;
  keep_triangles(result, kept_triangles);
  result = without_unused_vertices(result);
  if (context.cancelled()) return cancelled();

  RepairReport report;
  report.components = sizes.size();
  report.removed_components = static_cast<std::size_t>(std::count(kept.begin(), kept.end(), false));
  report.removed_triangles = mesh.triangles.size() - result.triangles.size();
  report.removed_vertices = mesh.positions.size() - result.positions.size();
  std::swap(mesh, result);
  context.progress(1);
  return report;
}

}  // namespace burnish
