#include "burnish/measure/one_ring_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "burnish/measure/angle_between.h"

namespace burnish {
namespace {

using Spoke = OneRingTable::Corner;

/// The corners at `vertex`, by (from, to); angles not yet known.
std::vector<Spoke> corners_at(const TriangleMesh& mesh, std::uint32_t vertex) {
  std::vector<Spoke> corners;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = t[(i + 1) % 3], to = t[(i + 2) % 3];
      if (t[i] == vertex && from != vertex && to != vertex && from != to) {
        corners.push_back({from, to, 0});
      }
    }
  }
  std::sort(corners.begin(), corners.end(), [](const Spoke& a, const Spoke& b) {
    return a.from != b.from ? a.from < b.from : a.to < b.to;
  });
  return corners;
}

/// The corners so that each begins, as far as possible, where the one before it ended.
std::vector<Spoke> around(std::vector<Spoke> left) {
  std::vector<Spoke> ordered;
  while (!left.empty()) {
    const auto begins_chain = [&](const Spoke& spoke) {
      return std::none_of(left.begin(), left.end(),
                          [&](const Spoke& other) { return other.to == spoke.from; });
    };
    auto next = std::find_if(left.begin(), left.end(), begins_chain);
    if (next == left.end()) next = left.begin();
    while (next != left.end()) {
      ordered.push_back(*next);
      left.erase(next);
      next = std::find_if(left.begin(), left.end(),
                          [&](const Spoke& spoke) { return spoke.from == ordered.back().to; });
    }
  }
  return ordered;
}

}  // namespace

double printed_distance(const Vec3d& a, const Vec3d& b) {
  const Vec3d d = a - b;
  return std::sqrt(std::sqrt(std::abs(d.x)) + std::sqrt(std::abs(d.y)) + std::sqrt(std::abs(d.z)));
}

Result<OneRingTable> one_ring_table(const TriangleMesh& mesh, std::uint32_t vertex) {
  if (auto sound = check(mesh); !sound) return sound.error();
  if (vertex >= mesh.positions.size()) {
    return Error{ErrorCode::invalid_argument,
                 fmt::format("vertex {} of {}", vertex, mesh.positions.size()),
                 {}};
  }
  OneRingTable table;
  table.vertex = vertex;
  table.position = mesh.frame.origin + Vec3d(mesh.positions[vertex]);
  table.corners = around(corners_at(mesh, vertex));

  // Offsets from the vertex, not world coordinates, keep the accuracy that positions have.
  const auto offset = [&](std::uint32_t w) {
    return Vec3d(mesh.positions[w]) - Vec3d(mesh.positions[vertex]);
  };
  const auto add = [&](std::uint32_t w) {
    const auto same = [w](const OneRingTable::Neighbour& n) { return n.vertex == w; };
    if (std::any_of(table.neighbours.begin(), table.neighbours.end(), same)) return;
    table.neighbours.push_back({w, mesh.frame.origin + Vec3d(mesh.positions[w]), norm(offset(w)), 0,
                                printed_distance(offset(w), {}), 0});
  };
  for (Spoke& corner : table.corners) {
    add(corner.from);
    add(corner.to);
    const Vec3d a = offset(corner.from), b = offset(corner.to);
    corner.angle = angle_between(a, b);
  }
  if (table.corners.empty()) return table;

  const auto count = static_cast<double>(table.neighbours.size());
  for (const auto& n : table.neighbours) {
    table.mean_distance += n.distance / count;
    table.mean_printed_distance += n.printed_distance / count;
  }
  for (auto& n : table.neighbours) {
    n.deviation = std::abs(table.mean_distance - n.distance);
    n.printed_deviation = std::abs(table.mean_printed_distance - n.printed_distance);
  }
  const auto [least, greatest] =
      std::minmax_element(table.corners.begin(), table.corners.end(),
                          [](const Spoke& a, const Spoke& b) { return a.angle < b.angle; });
  table.smallest_angle = least->angle;
  table.largest_angle = greatest->angle;
  return table;
}

Facts OneRingTable::facts() const {
  double deviation = 0;
  for (const Neighbour& n : neighbours) deviation = std::max(deviation, n.deviation);
  return {{"vertex", static_cast<double>(vertex), ""},
          {"neighbours", static_cast<double>(neighbours.size()), ""},
          {"mean_distance", mean_distance, "m"},
          {"largest_deviation", deviation, "m"},
          {"smallest_angle", smallest_angle, "rad"},
          {"largest_angle", largest_angle, "rad"}};
}

}  // namespace burnish
