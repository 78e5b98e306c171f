#include "burnish/spatial/closest_point.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace burnish {
namespace {

constexpr std::uint32_t kLeafSize = 4;

}  // namespace

Vec3d closest_on_segment(const Vec3d& query, const Vec3d& a, const Vec3d& b) {
  const Vec3d along = b - a;
  const double length = squared_norm(along);
  if (!(length > 0)) return a;
  const double t = dot(query - a, along) / length;
  return t <= 0 ? a : t >= 1 ? b : a + t * along;
}

Vec3d closest_on_triangle(const Vec3d& query, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d normal = cross(b - a, c - a);
  const double area = squared_norm(normal);
  // The areas that the query, projected, spans with the three edges; negative beyond an edge.
  const std::array<Vec3d, 3> corners{a, b, c};
  std::array<double, 3> beside{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d& from = corners[i];
    beside[i] = dot(cross(corners[(i + 1) % 3] - from, query - from), normal);
  }
  if (area > 0 && beside[0] >= 0 && beside[1] >= 0 && beside[2] >= 0) {
    return (beside[1] * a + beside[2] * b + beside[0] * c) / (beside[0] + beside[1] + beside[2]);
  }
  Vec3d best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    if (area > 0 && beside[i] >= 0) continue;  // the way to the query leads through another edge
    const Vec3d point = closest_on_segment(query, corners[i], corners[(i + 1) % 3]);
    const double distance = squared_norm(query - point);
    if (distance < least) {
      least = distance;
      best = point;
    }
  }
  return best;
}

double ClosestPoint::Node::squared_distance(const Vec3d& query) const {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double outside = std::max({low[axis] - query[axis], query[axis] - high[axis], 0.0});
    sum += outside * outside;
  }
  return sum;
}

/// Splits at the median of the longest side, so that the tree depends on the mesh alone.
struct ClosestPoint::Builder {
  const TriangleMesh& mesh;
  const Context& context;
  std::vector<Node>& nodes;
  std::vector<Vec3f> low, high;      ///< of each triangle
  std::vector<std::uint32_t> order;  ///< triangles, to be arranged leaf by leaf

  Builder(const TriangleMesh& m, const Context& stop, std::vector<Node>& n)
      : mesh(m), context(stop), nodes(n), order(m.triangles.size()) {
    std::iota(order.begin(), order.end(), 0u);
    for (const auto& [a, b, c] : m.triangles) {
      const Vec3f &p = m.positions[a], &q = m.positions[b], &r = m.positions[c];
      low.push_back(
          {std::min({p.x, q.x, r.x}), std::min({p.y, q.y, r.y}), std::min({p.z, q.z, r.z})});
      high.push_back(
          {std::max({p.x, q.x, r.x}), std::max({p.y, q.y, r.y}), std::max({p.z, q.z, r.z})});
    }
  }

  void build(std::uint32_t begin, std::uint32_t end) {
    constexpr std::uint32_t kCheckStop = 10000;
    if (end - begin > kCheckStop && context.cancelled()) return;
    const std::size_t node = nodes.size();
    Node box{low[order[begin]], high[order[begin]], begin, end - begin};
    for (std::uint32_t i = begin; i < end; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        box.low[axis] = std::min(box.low[axis], low[order[i]][axis]);
        box.high[axis] = std::max(box.high[axis], high[order[i]][axis]);
      }
    }
    nodes.push_back(box);
    if (end - begin <= kLeafSize) return;

    const Vec3d side = Vec3d(box.high) - Vec3d(box.low);
    const std::size_t axis = side.x >= side.y && side.x >= side.z ? 0 : side.y >= side.z ? 1 : 2;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order.begin() + begin, order.begin() + middle, order.begin() + end,
                     [&](std::uint32_t s, std::uint32_t t) {
                       const double at_s = double{low[s][axis]} + double{high[s][axis]};
                       const double at_t = double{low[t][axis]} + double{high[t][axis]};
                       return at_s != at_t ? at_s < at_t : s < t;
                     });
    build(begin, middle);
    nodes[node].first = static_cast<std::uint32_t>(nodes.size());
    nodes[node].count = 0;
    build(middle, end);
  }
};

ClosestPoint::ClosestPoint(const TriangleMesh& mesh, const Context& context) {
  if (mesh.triangles.empty()) return;
  Builder builder(mesh, context, nodes_);
  builder.build(0, static_cast<std::uint32_t>(mesh.triangles.size()));
  if (context.cancelled()) {
    nodes_.clear();
    return;
  }
  corners_.reserve(mesh.triangles.size());
  for (const std::uint32_t t : builder.order) {
    const auto [a, b, c] = mesh.triangles[t];
    corners_.push_back({mesh.positions[a], mesh.positions[b], mesh.positions[c], t});
  }
}

ClosestPoint::Found ClosestPoint::operator()(const Vec3d& query) const {
  Found found;
  if (nodes_.empty()) return found;
  double least = std::numeric_limits<double>::infinity();
  struct Visit {
    std::uint32_t node;
    double distance;
  };
  std::array<Visit, 64> waiting;  // one per level of the tree, which halves at every step
  std::size_t count = 0;
  waiting[count++] = {0, nodes_[0].squared_distance(query)};
  while (count > 0) {
    const Visit visit = waiting[--count];
    if (visit.distance > least) continue;
    const Node& node = nodes_[visit.node];
    if (node.count == 0) {
      Visit near{visit.node + 1, nodes_[visit.node + 1].squared_distance(query)};
      Visit far{node.first, nodes_[node.first].squared_distance(query)};
      if (far.distance < near.distance) std::swap(near, far);
      if (far.distance <= least) waiting[count++] = far;
      if (near.distance <= least) waiting[count++] = near;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Corners& t = corners_[i];
      const Vec3d point = closest_on_triangle(query, Vec3d(t.a), Vec3d(t.b), Vec3d(t.c));
      const double distance = squared_norm(query - point);
      if (distance < least || (distance == least && t.triangle < found.triangle)) {
        least = distance;
        found.point = point;
        found.triangle = t.triangle;
      }
    }
  }
  found.distance = std::sqrt(least);
  return found;
}

}  // namespace burnish
