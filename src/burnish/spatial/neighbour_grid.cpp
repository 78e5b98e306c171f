#include "burnish/spatial/neighbour_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace burnish {
namespace {

constexpr std::uint32_t kLeaf = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kCoarseNode = 2048;     ///< nodes with more points only share them out
constexpr double kCoarsePointsPerCell = 128;  ///< aimed at in an occupied cell of such a node
constexpr double kPointsPerCell = 2;          ///< aimed at in an occupied cell of the others
constexpr std::uint32_t kCrowdedCoarse = 8;   ///< a cell with more points becomes a node
constexpr std::uint32_t kCrowded = 32;
constexpr std::size_t kFew = 64;

bool nearer(const Neighbour& a, const Neighbour& b) {
  return a.squared_distance != b.squared_distance ? a.squared_distance < b.squared_distance
                                                  : a.index < b.index;
}

/// The cell that holds coordinate `x`, at most one cell outside the grid; rises with `x`.
std::int32_t cell_of(double x, double low, double inverse_cell, std::int32_t size) {
  const double cell = std::floor((x - low) * inverse_cell);
  return static_cast<std::int32_t>(std::clamp(cell, -1.0, static_cast<double>(size)));
}

std::int32_t inner_cell_of(double x, double low, double inverse_cell, std::int32_t size) {
  return std::clamp(cell_of(x, low, inverse_cell, size), 0, size - 1);
}

double outside(double x, double low, double high) {
  return std::max({low - x, x - high, 0.0});
}

/// Sorts few neighbours without branches that depend on them: each goes to the place that the
/// number of nearer ones gives. Leaves the nearest `wanted`.
void sort_few(std::vector<Neighbour>& found, std::size_t wanted) {
  std::array<double, kFew> distance, index;
  std::array<Neighbour, kFew> sorted;
  const std::size_t count = found.size();
  for (std::size_t i = 0; i < count; ++i) {
    distance[i] = found[i].squared_distance;
    index[i] = found[i].index;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const double d = distance[i], n = index[i];
    double place = 0;
    for (std::size_t j = 0; j < count; ++j) {
      place += ((distance[j] < d) | ((distance[j] == d) & (index[j] < n))) ? 1.0 : 0.0;
    }
    sorted[static_cast<std::size_t>(place)] = found[i];
  }
  found.resize(std::min(count, wanted));
  std::copy_n(sorted.begin(), found.size(), found.begin());
}

/// Leaves the nearest `wanted`, in no order.
void keep_nearest(std::vector<Neighbour>& found, std::size_t wanted) {
  if (found.size() <= wanted) return;
  const auto last = found.begin() + static_cast<std::ptrdiff_t>(wanted) - 1;
  std::nth_element(found.begin(), last, found.end(), nearer);
  found.resize(wanted);
}

void sort_nearest(std::vector<Neighbour>& found, std::size_t wanted) {
  if (found.size() <= kFew) return sort_few(found, wanted);
  keep_nearest(found, wanted);
  std::sort(found.begin(), found.end(), nearer);
}

}  // namespace

/// A ball that shrinks once it holds many more points than are wanted.
struct NeighbourGrid::Search {
  Vec3d centre;
  double radius, squared_radius;
  std::size_t wanted;
  std::vector<Neighbour>& found;  ///< the first `count` are those in the ball
  std::size_t count = 0;

  Search(const Vec3d& query, double r, std::size_t nearest, std::vector<Neighbour>& result)
      : centre(query), radius(r), squared_radius(r * r), wanted(nearest), found(result) {}

  void add(const Point* begin, const Point* end) {
    const std::size_t room = count + static_cast<std::size_t>(end - begin);
    if (found.size() < room) found.resize(room);
    for (const Point* p = begin; p != end; ++p) {
      const double squared = squared_norm(Vec3d(p->position) - centre);
      found[count] = {p->index, squared};
      count += squared <= squared_radius;
    }
    if (count / 4 > wanted + 8) shrink();
  }

  void shrink() {
    found.resize(count);
    keep_nearest(found, wanted);
    count = wanted;
    squared_radius = found.back().squared_distance;
    radius = std::sqrt(squared_radius);
  }
};

NeighbourGrid::NeighbourGrid(std::span<const Vec3f> points) {
  points_.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (is_finite(points[i])) points_.push_back({points[i], i});
  }
  if (points_.empty()) return;
  sorted_.resize(points_.size());
  build(0, static_cast<std::uint32_t>(points_.size()));
  sorted_ = {};
}

/// Makes the node of the points [begin, end) and, below it, those of its crowded cells.
std::uint32_t NeighbourGrid::build(std::uint32_t begin, std::uint32_t end) {
  const double count = end - begin;
  const bool coarse = end - begin > kCoarseNode;
  Vec3f low = points_[begin].position, high = low;
  for (std::uint32_t i = begin; i < end; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], points_[i].position[axis]);
      high[axis] = std::max(high[axis], points_[i].position[axis]);
    }
  }
  const Vec3d extent = Vec3d(high) - Vec3d(low);
  std::array<double, 3> sides{extent.x, extent.y, extent.z};
  std::sort(sides.begin(), sides.end());

  Node node{.low = Vec3d(low)};
  node.coincident = sides[2] == 0;
  node.area_per_point =
      std::max(sides[1] * sides[2] / count, sides[2] * sides[2] / (count * count));
  const double per_cell = coarse ? kCoarsePointsPerCell : kPointsPerCell;
  const double most_cells = coarse ? count / 64 : 4 * count + 8;
  node.cell =
      std::max(std::sqrt(sides[1] * sides[2] * per_cell / count), sides[2] * per_cell / count);
  // Underflow in denormal coordinates must not stop the division into cells.
  node.cell = std::max(node.cell, sides[2] * 1e-6);
  if (!(node.cell > 0)) node.cell = 1;
  for (;; node.cell *= 1.25) {
    node.inverse_cell = 1 / node.cell;
    double cells = 1;
    for (const double side : sides) cells *= std::floor(side * node.inverse_cell) + 1;
    if (cells <= most_cells) break;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    node.size[axis] = static_cast<std::int32_t>(std::floor(extent[axis] * node.inverse_cell)) + 1;
  }
  node.first_start = static_cast<std::uint32_t>(starts_.size());
  sort_into_cells(node, begin, end);

  const std::uint32_t number = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(node);
  if (node.coincident) return number;
  const std::uint32_t crowded = coarse ? kCrowdedCoarse : kCrowded;
  const std::size_t cells = starts_.size() - node.first_start - 1;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const std::uint32_t from = starts_[node.first_start + cell];
    const std::uint32_t to = starts_[node.first_start + cell + 1];
    if (to - from <= crowded) continue;
    if (nodes_[number].first_child < 0) {
      nodes_[number].first_child = static_cast<std::int64_t>(children_.size());
      children_.resize(children_.size() + cells, kLeaf);
    }
    const std::uint32_t child = build(from, to);
    children_[static_cast<std::size_t>(nodes_[number].first_child) + cell] = child;
  }
  return number;
}

/// Counting sort by cell, stable: points of one cell stay in the order of their indices.
void NeighbourGrid::sort_into_cells(const Node& node, std::uint32_t begin, std::uint32_t end) {
  const auto number_of = [&node](const Vec3f& p) {
    const auto x = inner_cell_of(p.x, node.low.x, node.inverse_cell, node.size[0]);
    const auto y = inner_cell_of(p.y, node.low.y, node.inverse_cell, node.size[1]);
    const auto z = inner_cell_of(p.z, node.low.z, node.inverse_cell, node.size[2]);
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(node.size[1]) +
            static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(node.size[0]) +
           static_cast<std::size_t>(x);
  };
  const std::size_t cells = static_cast<std::size_t>(node.size[0]) *
                            static_cast<std::size_t>(node.size[1]) *
                            static_cast<std::size_t>(node.size[2]);
  starts_.resize(node.first_start + cells + 1, 0);
  std::uint32_t* starts = starts_.data() + node.first_start;
  for (std::uint32_t i = begin; i < end; ++i) ++starts[number_of(points_[i].position)];
  std::uint32_t next = begin;
  for (std::size_t cell = 0; cell <= cells; ++cell) {
    const std::uint32_t count = cell < cells ? starts[cell] : 0;
    starts[cell] = next;
    next += count;
  }
  for (std::uint32_t i = begin; i < end; ++i) {
    sorted_[starts[number_of(points_[i].position)]++] = points_[i];
  }
  for (std::size_t cell = cells; cell > 0; --cell) starts[cell] = starts[cell - 1];
  starts[0] = begin;
  std::copy(sorted_.begin() + begin, sorted_.begin() + end, points_.begin() + begin);
}

void NeighbourGrid::scan(std::uint32_t begin, std::uint32_t end, Search& search) const {
  search.add(points_.data() + begin, points_.data() + end);
}

void NeighbourGrid::visit(std::uint32_t number, Search& search) const {
  const Node& node = nodes_[number];
  const std::uint32_t* starts = starts_.data() + node.first_start;
  if (node.coincident) {
    scan(starts[0],
         std::min<std::uint32_t>(starts[1],
                                 starts[0] + static_cast<std::uint32_t>(std::min<std::size_t>(
                                                 search.wanted, starts[1] - starts[0]))),
         search);
    return;
  }
  // A hair more than the radius: rounding must not lose a point that lies on the sphere.
  const double reach = search.radius * (1 + 1e-6);
  std::array<std::int32_t, 3> from, to;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double x = search.centre[axis];
    from[axis] = cell_of(x - reach, node.low[axis], node.inverse_cell, node.size[axis]);
    to[axis] = cell_of(x + reach, node.low[axis], node.inverse_cell, node.size[axis]);
    if (to[axis] < 0 || from[axis] >= node.size[axis]) return;
    from[axis] = std::max(from[axis], 0);
    to[axis] = std::min(to[axis], node.size[axis] - 1);
  }
  for (std::int32_t z = from[2]; z <= to[2]; ++z) {
    for (std::int32_t y = from[1]; y <= to[1]; ++y) {
      const std::size_t row =
          (static_cast<std::size_t>(z) * static_cast<std::size_t>(node.size[1]) +
           static_cast<std::size_t>(y)) *
          static_cast<std::size_t>(node.size[0]);
      if (node.first_child < 0) {
        scan(starts[row + static_cast<std::size_t>(from[0])],
             starts[row + static_cast<std::size_t>(to[0]) + 1], search);
        continue;
      }
      for (std::int32_t x = from[0]; x <= to[0]; ++x) {
        const std::size_t cell = row + static_cast<std::size_t>(x);
        const std::uint32_t child = children_[static_cast<std::size_t>(node.first_child) + cell];
        if (child == kLeaf) {
          scan(starts[cell], starts[cell + 1], search);
        } else {
          visit(child, search);
        }
      }
    }
  }
}

/// Of the smallest grid around the query: what the first radius is guessed from.
double NeighbourGrid::area_per_point_near(const Vec3d& query) const {
  for (std::uint32_t number = 0;;) {
    const Node& node = nodes_[number];
    if (node.first_child < 0) return node.area_per_point;
    std::size_t cell = 0;
    for (const std::size_t axis : {2, 1, 0}) {
      cell = cell * static_cast<std::size_t>(node.size[axis]) +
             static_cast<std::size_t>(
                 inner_cell_of(query[axis], node.low[axis], node.inverse_cell, node.size[axis]));
    }
    const std::uint32_t child = children_[static_cast<std::size_t>(node.first_child) + cell];
    if (child == kLeaf) return node.area_per_point;
    number = child;
  }
}

void NeighbourGrid::nearest(const Vec3f& query, std::size_t count,
                            std::vector<Neighbour>& found) const {
  found.clear();
  count = std::min(count, points_.size());
  if (count == 0 || !is_finite(query)) return;
  const Vec3d centre(query);
  const Node& root = nodes_[0];
  Vec3d to_box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    to_box[axis] =
        outside(centre[axis], root.low[axis], root.low[axis] + root.size[axis] * root.cell);
  }
  // On an evenly sampled surface a disc of this radius holds a few points more than are asked for.
  double radius = norm(to_box) + std::sqrt(1.3 * (static_cast<double>(count) + 2) *
                                           area_per_point_near(centre) / std::numbers::pi);
  for (;;) {
    Search search(centre, radius, count, found);
    visit(0, search);
    found.resize(search.count);
    if (search.count >= count) break;
    const double missing = static_cast<double>(count) / (static_cast<double>(search.count) + 0.5);
    radius *= std::clamp(1.15 * std::sqrt(missing), 1.2, 2.0);
    radius = std::max(radius, static_cast<double>(std::numeric_limits<float>::denorm_min()));
  }
  sort_nearest(found, count);
}

void NeighbourGrid::within(const Vec3f& query, double radius, std::vector<Neighbour>& found) const {
  found.clear();
  if (points_.empty() || !is_finite(query) || !(radius >= 0)) return;
  Search search(Vec3d(query), radius, points_.size(), found);
  visit(0, search);
  found.resize(search.count);
  sort_nearest(found, search.count);
}

}  // namespace burnish
