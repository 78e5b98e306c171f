#include "burnish/spatial/point_octree.h"

#include <algorithm>
#include <cmath>

#include "burnish/spatial/nearest_list.h"

namespace burnish {
namespace {

constexpr std::size_t kChildren = 8;

}  // namespace

/// Never more than the distance to a point in the box, rounded as that is: every step of the sum
/// rises with the coordinates' differences.
double PointOctree::Node::squared_distance(const Vec3d& query) const {
  const Vec3d under = Vec3d(low) - query, over = query - Vec3d(high);
  return squared_norm(Vec3d{std::max({under.x, over.x, 0.0}), std::max({under.y, over.y, 0.0}),
                            std::max({under.z, over.z, 0.0})});
}

std::size_t PointOctree::Cell::octant(const Vec3f& p) const {
  return (p.x >= centre.x ? 1u : 0u) | (p.y >= centre.y ? 2u : 0u) | (p.z >= centre.z ? 4u : 0u);
}

PointOctree::Cell PointOctree::Cell::child(std::size_t octant) const {
  const double shift = half / 2;
  return {centre + Vec3d{octant & 1 ? shift : -shift, octant & 2 ? shift : -shift,
                         octant & 4 ? shift : -shift},
          shift};
}

bool PointOctree::Cell::contains(const Vec3f& p) const {
  return std::abs(p.x - centre.x) < half && std::abs(p.y - centre.y) < half &&
         std::abs(p.z - centre.z) < half;
}

std::span<PointOctree::Entry> PointOctree::entries(const Node& leaf) {
  if (leaf.count == 0) return {};
  return {buckets_[leaf.below].data(), leaf.count};
}

std::span<const PointOctree::Entry> PointOctree::entries(const Node& leaf) const {
  if (leaf.count == 0) return {};
  return {buckets_[leaf.below].data(), leaf.count};
}

PointOctree::Entry& PointOctree::entry_of(std::uint32_t leaf, std::uint32_t index) {
  const std::span<Entry> all = entries(nodes_[leaf]);
  return *std::find_if(all.begin(), all.end(), [&](const Entry& e) { return e.index == index; });
}

std::uint32_t PointOctree::new_children() {
  if (!free_children_.empty()) {
    const std::uint32_t first = free_children_.back();
    free_children_.pop_back();
    std::fill_n(nodes_.begin() + first, kChildren, Node{});
    return first;
  }
  nodes_.resize(nodes_.size() + kChildren);
  return static_cast<std::uint32_t>(nodes_.size() - kChildren);
}

std::uint32_t PointOctree::new_bucket() {
  if (free_buckets_.empty()) {
    buckets_.emplace_back();
    return static_cast<std::uint32_t>(buckets_.size() - 1);
  }
  const std::uint32_t bucket = free_buckets_.back();
  free_buckets_.pop_back();
  return bucket;
}

void PointOctree::append(std::uint32_t leaf, Entry entry) {
  if (nodes_[leaf].count == 0) nodes_[leaf].below = new_bucket();
  buckets_[nodes_[leaf].below][nodes_[leaf].count++] = entry;
}

/// Box, count and reach of a node from what is directly below it.
void PointOctree::summarise(std::uint32_t number) {
  Node& node = nodes_[number];
  constexpr float kFar = std::numeric_limits<float>::infinity();
  node.low = {kFar, kFar, kFar};
  node.high = -node.low;
  node.squared_reach = 0;
  const auto include = [&node](const Vec3f& low, const Vec3f& high, double squared_reach) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      node.low[axis] = std::min(node.low[axis], low[axis]);
      node.high[axis] = std::max(node.high[axis], high[axis]);
    }
    node.squared_reach = std::max(node.squared_reach, squared_reach);
  };
  if (node.leaf) {
    for (const Entry& e : entries(node)) include(e.position, e.position, e.squared_reach);
    return;
  }
  node.count = 0;
  for (std::size_t i = 0; i < kChildren; ++i) {
    const Node& child = nodes_[node.below + i];
    if (child.count == 0) continue;
    node.count += child.count;
    include(child.low, child.high, child.squared_reach);
  }
}

/// A cell with room to spare around a box. Its centre is a small multiple of its side, so that
/// halving rounds nothing before floats are told apart.
PointOctree::Cell PointOctree::Cell::around(const Vec3f& low, const Vec3f& high) {
  double extent = 0, size = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    extent = std::max(extent, double{high[axis]} - double{low[axis]});
    size = std::max<double>({size, std::abs(low[axis]), std::abs(high[axis])});
  }
  extent = std::max(extent, size / 1024);
  Cell cell{{}, extent > 0 ? std::ldexp(1.0, std::ilogb(extent) + 2) : 1};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double middle = (double{low[axis]} + double{high[axis]}) / 2;
    cell.centre[axis] = std::floor(middle / cell.half + 0.5) * cell.half;
  }
  return cell;
}

/// Replaces the root's cell where `p` lies outside. Every time the cell becomes larger, or most of
/// it lay idle.
void PointOctree::make_room_for(const Vec3f& p) {
  if (size() > 0 && root_.contains(p)) return;
  Node& root = nodes_[0];
  Vec3f low = p, high = p;
  for (std::size_t axis = 0; axis < 3 && size() > 0; ++axis) {
    low[axis] = std::min(low[axis], root.low[axis]);
    high[axis] = std::max(high[axis], root.high[axis]);
  }
  std::vector<Entry> all;
  collect(root, all);
  *this = {};
  root_ = Cell::around(low, high);
  for (const Entry& entry : all) insert_below(0, root_, entry);
}

void PointOctree::collect(const Node& node, std::vector<Entry>& found) const {
  if (node.leaf) {
    found.insert(found.end(), entries(node).begin(), entries(node).end());
    return;
  }
  for (std::size_t i = 0; i < kChildren; ++i) collect(nodes_[node.below + i], found);
}

void PointOctree::insert(std::uint32_t index, const Vec3f& position, double squared_reach) {
  make_room_for(position);
  insert_below(0, root_, {position, index, squared_reach});
}

void PointOctree::insert_below(std::uint32_t node, const Cell& cell, const Entry& entry) {
  if (nodes_[node].leaf && nodes_[node].count == kBucket) split(node, cell);
  if (nodes_[node].leaf) {
    append(node, entry);
  } else {
    const std::size_t octant = cell.octant(entry.position);
    const auto child = static_cast<std::uint32_t>(nodes_[node].below + octant);
    insert_below(child, cell.child(octant), entry);
  }
  summarise(node);
}

void PointOctree::split(std::uint32_t node, const Cell& cell) {
  const std::uint32_t bucket = nodes_[node].below;
  const Bucket shared_out = buckets_[bucket];
  free_buckets_.push_back(bucket);
  const std::uint32_t children = new_children();
  nodes_[node].leaf = false;
  nodes_[node].below = children;
  for (const Entry& entry : shared_out) {
    append(static_cast<std::uint32_t>(children + cell.octant(entry.position)), entry);
  }
  for (std::uint32_t i = 0; i < kChildren; ++i) summarise(children + i);
}

/// The children of a node with few points are leaves: a node with few points is one.
void PointOctree::collapse(std::uint32_t node) {
  const std::uint32_t children = nodes_[node].below;
  nodes_[node].leaf = true;
  nodes_[node].count = 0;
  for (std::uint32_t i = 0; i < kChildren; ++i) {
    const Node child = nodes_[children + i];
    for (std::size_t e = 0; e < child.count; ++e) append(node, buckets_[child.below][e]);
    if (child.count > 0) free_buckets_.push_back(child.below);
  }
  free_children_.push_back(children);
}

template <class Change>
void PointOctree::change_leaf_of(const Vec3f& p, std::uint32_t node, const Cell& cell,
                                 Change change) {
  if (nodes_[node].leaf) {
    change(node);
  } else {
    const std::size_t octant = cell.octant(p);
    const auto child = static_cast<std::uint32_t>(nodes_[node].below + octant);
    change_leaf_of(p, child, cell.child(octant), change);
  }
  summarise(node);
  if (!nodes_[node].leaf && nodes_[node].count <= kFew) collapse(node);
}

void PointOctree::erase(std::uint32_t index, const Vec3f& position) {
  change_leaf_of(position, 0, root_, [&](std::uint32_t leaf) {
    Node& node = nodes_[leaf];
    std::swap(entry_of(leaf, index), entries(node).back());
    if (--node.count == 0) free_buckets_.push_back(node.below);
  });
}

void PointOctree::set_reach(std::uint32_t index, const Vec3f& position, double squared_reach) {
  change_leaf_of(position, 0, root_,
                 [&](std::uint32_t leaf) { entry_of(leaf, index).squared_reach = squared_reach; });
}

struct PointOctree::NearestSearch {
  Vec3d query;
  NearestList list;
};

void PointOctree::visit(const Node& node, NearestSearch& search) const {
  if (node.leaf) {
    for (const Entry& entry : entries(node)) {
      search.list.offer({entry.index, squared_norm(Vec3d(entry.position) - search.query)});
    }
    return;
  }
  struct Ahead {
    double squared_distance;
    const Node* child;
  };
  std::array<Ahead, kChildren> ahead;
  std::size_t count = 0;
  for (std::size_t i = 0; i < kChildren; ++i) {
    const Node& child = nodes_[node.below + i];
    if (child.count == 0) continue;
    const Ahead here{child.squared_distance(search.query), &child};
    std::size_t place = count++;
    for (; place > 0 && here.squared_distance < ahead[place - 1].squared_distance; --place) {
      ahead[place] = ahead[place - 1];
    }
    ahead[place] = here;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (ahead[i].squared_distance > search.list.squared_radius()) return;
    visit(*ahead[i].child, search);
  }
}

void PointOctree::nearest(const Vec3f& query, std::size_t count,
                          std::vector<Neighbour>& found) const {
  NearestSearch search{Vec3d(query), NearestList(count, found)};
  visit(nodes_[0], search);
}

void PointOctree::visit(const Node& node, const Vec3d& query,
                        std::vector<std::uint32_t>& found) const {
  if (node.leaf) {
    for (const Entry& e : entries(node)) {
      if (squared_norm(Vec3d(e.position) - query) <= e.squared_reach) found.push_back(e.index);
    }
    return;
  }
  for (std::size_t i = 0; i < kChildren; ++i) {
    const Node& child = nodes_[node.below + i];
    if (child.count > 0 && child.squared_distance(query) <= child.squared_reach) {
      visit(child, query, found);
    }
  }
}

void PointOctree::reaching(const Vec3f& query, std::vector<std::uint32_t>& found) const {
  found.clear();
  visit(nodes_[0], Vec3d(query), found);
}

}  // namespace burnish
