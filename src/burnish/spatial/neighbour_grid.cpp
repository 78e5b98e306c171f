#include "burnish/spatial/neighbour_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "burnish/base/parallel.h"
#include "burnish/base/small_sort.h"

namespace burnish {
namespace {

constexpr std::uint32_t kLeaf = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kCoarseNode = 2048;     ///< nodes with more points only share them out
constexpr double kCoarsePointsPerCell = 128;  ///< aimed at in an occupied cell of such a node
constexpr double kPointsPerCell = 2;          ///< aimed at in an occupied cell of the others
constexpr std::uint32_t kCrowdedCoarse = 8;   ///< a cell with more points becomes a node
constexpr std::uint32_t kCrowded = 32;
constexpr std::size_t kFew = 64;
/// A ball is looked up as a hair larger: rounding must not lose a point that lies on it.
constexpr double kHair = 1 + 1e-6;
/// So many points in the order of the cells look for their neighbours together.
constexpr std::ptrdiff_t kTogether = 8;
constexpr double kSpread = 4;  ///< widest group, in radii
/// The radius that sufficed for a group is tried with the next one, a little wider.
constexpr double kWider = 1.1;

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

/// What to try where `radius` held only `found` of `count` points.
double larger_radius(double radius, std::size_t found, std::size_t count) {
  const double missing = static_cast<double>(count) / (static_cast<double>(found) + 0.5);
  radius *= std::clamp(1.15 * std::sqrt(missing), 1.2, 2.0);
  return std::max(radius, static_cast<double>(std::numeric_limits<float>::denorm_min()));
}

/// Leaves the nearest `wanted`, in no order.
void keep_nearest(std::vector<Neighbour>& found, std::size_t wanted) {
  if (found.size() <= wanted) return;
  const auto last = found.begin() + static_cast<std::ptrdiff_t>(wanted) - 1;
  std::nth_element(found.begin(), last, found.end(), nearer);
  found.resize(wanted);
}

void sort_nearest(std::vector<Neighbour>& found, std::size_t wanted) {
  if (found.size() > kFew) keep_nearest(found, wanted);
  small_sort(
      std::span(found),
      [](const Neighbour& neighbour) { return static_cast<float>(neighbour.squared_distance); },
      nearer);
  found.resize(std::min(found.size(), wanted));
}

}  // namespace

/// A ball that shrinks once it holds many more points than are wanted.
struct NeighbourGrid::Search {
  Vec3d centre;
  double radius, squared_radius;
  std::size_t wanted;
  std::vector<Neighbour>& found;  ///< the first `count` are those in the ball
  std::size_t count = 0;

  double low(std::size_t axis) const { return centre[axis] - radius * kHair; }
  double high(std::size_t axis) const { return centre[axis] + radius * kHair; }

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

/// All points in a box around a few, coordinate by coordinate.
class NeighbourGrid::Gathered {
 public:
  std::size_t wanted;  ///< of coincident points no more than these are needed

  explicit Gathered(std::size_t nearest) : wanted(nearest) {}

  /// Empties it, for what is at most `margin` away from the box of the points [begin, end).
  void reset(const Point* begin, const Point* end, double margin) {
    low_ = high_ = Vec3d(begin->position);
    for (const Point* p = begin; p != end; ++p) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low_[axis] = std::min<double>(low_[axis], p->position[axis]);
        high_[axis] = std::max<double>(high_[axis], p->position[axis]);
      }
    }
    margin_ = margin * kHair;
    count_ = 0;
  }
  double low(std::size_t axis) const { return low_[axis] - margin_; }
  double high(std::size_t axis) const { return high_[axis] + margin_; }

  void add(const Point* begin, const Point* end) {
    const std::size_t room = count_ + static_cast<std::size_t>(end - begin);
    if (index_.size() < room) {
      for (auto* column : {&x_, &y_, &z_, &squared_}) column->resize(2 * room);
      index_.resize(2 * room);
    }
    for (const Point* p = begin; p != end; ++p, ++count_) {
      x_[count_] = p->position.x, y_[count_] = p->position.y, z_[count_] = p->position.z;
      index_[count_] = p->index;
    }
  }

  /// Those at most `radius` from `centre`, in no order.
  void select(const Vec3d& centre, double radius, std::vector<Neighbour>& found) {
    for (std::size_t i = 0; i < count_; ++i) {
      const double x = x_[i] - centre.x, y = y_[i] - centre.y, z = z_[i] - centre.z;
      squared_[i] = x * x + y * y + z * z;
    }
    found.resize(count_);
    std::size_t kept = 0;
    const double limit = radius * radius;
    for (std::size_t i = 0; i < count_; ++i) {
      found[kept] = {index_[i], squared_[i]};
      kept += squared_[i] <= limit;
    }
    found.resize(kept);
  }

 private:
  Vec3d low_, high_;
  double margin_ = 0;
  std::size_t count_ = 0;
  std::vector<double> x_, y_, z_, squared_;
  std::vector<std::uint32_t> index_;
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

template <class Query>
void NeighbourGrid::scan(std::uint32_t begin, std::uint32_t end, Query& query) const {
  query.add(points_.data() + begin, points_.data() + end);
}

template <class Query>
void NeighbourGrid::visit(std::uint32_t number, Query& query) const {
  const Node& node = nodes_[number];
  const std::uint32_t* starts = starts_.data() + node.first_start;
  if (node.coincident) {
    scan(starts[0],
         std::min<std::uint32_t>(starts[1],
                                 starts[0] + static_cast<std::uint32_t>(std::min<std::size_t>(
                                                 query.wanted, starts[1] - starts[0]))),
         query);
    return;
  }
  std::array<std::int32_t, 3> from, to;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    from[axis] = cell_of(query.low(axis), node.low[axis], node.inverse_cell, node.size[axis]);
    to[axis] = cell_of(query.high(axis), node.low[axis], node.inverse_cell, node.size[axis]);
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
             starts[row + static_cast<std::size_t>(to[0]) + 1], query);
        continue;
      }
      for (std::int32_t x = from[0]; x <= to[0]; ++x) {
        const std::size_t cell = row + static_cast<std::size_t>(x);
        const std::uint32_t child = children_[static_cast<std::size_t>(node.first_child) + cell];
        if (child == kLeaf) {
          scan(starts[cell], starts[cell + 1], query);
        } else {
          visit(child, query);
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

/// On an evenly sampled surface a disc of this radius holds a few points more than are asked for.
double NeighbourGrid::first_radius(const Vec3d& query, std::size_t count) const {
  return std::sqrt(1.3 * (static_cast<double>(count) + 2) * area_per_point_near(query) /
                   std::numbers::pi);
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
  double radius = norm(to_box) + first_radius(centre, count);
  for (;;) {
    Search search(centre, radius, count, found);
    visit(0, search);
    found.resize(search.count);
    if (search.count >= count) break;
    radius = larger_radius(radius, search.count, count);
  }
  sort_nearest(found, count);
}

/// The `count` nearest of each of the points [begin, end), which are close to each other, into
/// their rows. `radius` is tried first; left is what would have been enough.
void NeighbourGrid::nearest_of_group(const Point* begin, const Point* end, std::size_t count,
                                     double& radius, Gathered& gathered,
                                     std::vector<Neighbour>& found,
                                     std::vector<std::uint32_t>& rows) const {
  gathered.reset(begin, end, radius);
  visit(0, gathered);
  double enough = 0;
  for (const Point* p = begin; p != end; ++p) {
    for (;;) {
      gathered.select(Vec3d(p->position), radius, found);
      if (found.size() >= count) break;
      radius = larger_radius(radius, found.size(), count);
      gathered.reset(begin, end, radius);
      visit(0, gathered);
    }
    sort_nearest(found, count);
    enough = std::max(enough, found.back().squared_distance);
    std::uint32_t* row = rows.data() + p->index * count;
    for (const Neighbour& neighbour : found) *row++ = neighbour.index;
  }
  radius = std::sqrt(enough);
}

bool NeighbourGrid::nearest_of_all(std::size_t count, const Context& context,
                                   NeighbourLists& lists) const {
  count = std::min(count, points_.size());
  std::vector<std::uint32_t> rows(points_.size() * count);
  const bool complete = parallel_for(context, points_.size(), [&](IndexRange range) {
    Gathered gathered(count);
    std::vector<Neighbour> found;
    double radius = std::numeric_limits<double>::infinity();
    const Point* const end = points_.data() + range.end;
    for (const Point* first = points_.data() + range.begin; first != end;) {
      const Vec3d place(first->position);
      const double guess = first_radius(place, count);
      radius = std::clamp(kWider * radius, guess / 2, guess);
      const Point* last = first + 1;
      while (last != end && last - first < kTogether &&
             norm(Vec3d(last->position) - place) <= kSpread * guess) {
        ++last;
      }
      nearest_of_group(first, last, count, radius, gathered, found, rows);
      first = last;
    }
  });
  lists = {count, std::move(rows)};
  return complete;
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
