#include "burnish/adaptation/quadrisection.h"

#include <algorithm>

#include "burnish/adaptation/closed_pair.h"
#include "burnish/base/parallel.h"

namespace burnish {
namespace {

/// What becomes of one triangle.
class Cut {
 public:
  Cut(const Triangle& corners, std::size_t t, const Quadrisection& plan) : corners_(corners) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t edge = plan.edges.of_side(3 * t + i);
      // The middle between a vertex and itself is that vertex: it is there for any cut.
      middle_[i] = edge == kNoEdge ? corners[i] : plan.vertex_of_edge[edge];
      cut_edges_ += edge != kNoEdge && middle_[i] != kNoVertex;
      cut_sides_ += middle_[i] != kNoVertex;
    }
  }

  std::uint32_t parts() const { return cut_edges_ == 0 ? 1 : cut_sides_ + 1; }

  void write(const Placement& positions, Triangle* out) const {
    const auto [a, b, c] = corners_;
    const auto [ab, bc, ca] = middle_;
    if (parts() == 1) out[0] = corners_;
    if (parts() == 2) bisect(out);
    if (parts() == 3) trisect(positions, out);
    if (parts() < 4) return;
    out[0] = {a, ab, ca};
    out[1] = {b, bc, ab};
    out[2] = {c, ca, bc};
    out[3] = {ab, bc, ca};
  }

 private:
  std::uint32_t corner(std::size_t i) const { return corners_[i % 3]; }
  std::uint32_t middle(std::size_t i) const { return middle_[i % 3]; }

  void bisect(Triangle* out) const {
    std::size_t i = 0;
    while (middle(i) == kNoVertex) ++i;
    out[0] = {corner(i), middle(i), corner(i + 2)};
    out[1] = {middle(i), corner(i + 1), corner(i + 2)};
  }

  void trisect(const Placement& positions, Triangle* out) const {
    std::size_t i = 0;  // the side that is whole, from c to a
    while (middle(i) != kNoVertex) ++i;
    const std::uint32_t c = corner(i), a = corner(i + 1), b = corner(i + 2);
    const std::uint32_t ab = middle(i + 1), bc = middle(i + 2);
    const auto length = [&](std::uint32_t v, std::uint32_t w) {
      return squared_norm(Vec3d(positions[v]) - Vec3d(positions[w]));
    };
    const double from_a = length(a, bc), from_c = length(c, ab);
    out[0] = {ab, b, bc};
    if (from_a < from_c || (from_a == from_c && a < c)) {
      out[1] = {a, ab, bc};
      out[2] = {a, bc, c};
    } else {
      out[1] = {a, ab, c};
      out[2] = {ab, bc, c};
    }
  }

  Triangle corners_;
  std::array<std::uint32_t, 3> middle_;  ///< of side i, from corner i to the next
  std::uint32_t cut_edges_ = 0, cut_sides_ = 0;
};

}  // namespace

std::optional<Quadrisection> plan_quadrisection(const TriangleMesh& mesh,
                                                const RefinementZone& zone,
                                                const Context& context) {
  std::optional<EdgeTable> edges = EdgeTable::of(mesh, context);
  if (!edges) return {};
  Quadrisection plan{*std::move(edges), {}, {}};
  plan.vertex_of_edge.assign(plan.edges.size(), kNoVertex);
  auto next = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::size_t e = 0; e < plan.edges.size(); ++e) {
    const auto sides = plan.edges.sides(e);
    const bool cut = std::any_of(sides.begin(), sides.end(), [&](std::uint32_t side) {
      return zone.touches(mesh.triangles[side / 3]);
    });
    if (!cut || in_closed_pair(plan.edges, static_cast<std::uint32_t>(e))) continue;
    plan.vertex_of_edge[e] = next++;
    plan.parents.push_back(plan.edges.vertices(e));
  }
  return plan;
}

bool quadrisect(TriangleMesh& mesh, const Quadrisection& plan, Placement placement,
                const Context& context) {
  const std::size_t count = mesh.triangles.size();
  std::vector<std::uint32_t> first(count + 1, 0);
  const bool counted = parallel_for(context.part(0, 0.3), count, [&](IndexRange range) {
    for (std::size_t t = range.begin; t < range.end; ++t) {
      first[t + 1] = Cut(mesh.triangles[t], t, plan).parts();
    }
  });
  if (!counted) return false;
  for (std::size_t t = 0; t < count; ++t) first[t + 1] += first[t];

  std::vector<Triangle> triangles(first.back());
  const bool cut = parallel_for(context.part(0.3, 1), count, [&](IndexRange range) {
    for (std::size_t t = range.begin; t < range.end; ++t) {
      Cut(mesh.triangles[t], t, plan).write(placement, triangles.data() + first[t]);
    }
  });
  if (!cut) return false;
  inherit_attributes(mesh.triangle_attributes, first);
  mesh.triangles = std::move(triangles);
  append_interpolated<2>(mesh.attributes, mesh.positions.size(), plan.parents);
  std::move(placement).apply(mesh);
  return true;
}

}  // namespace burnish
