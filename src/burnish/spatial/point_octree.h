#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "burnish/base/vec3.h"
#include "burnish/spatial/neighbour_grid.h"

namespace burnish {

/// Points that come and go, each with a reach, a radius around it. Answers which points are nearest
/// to a place, and which points reach it.
///
/// Cells are halved along all axes where they hold more than a bucket of points and joined again
/// where few are left, so that they follow the density. Distances are computed in double from the
/// float coordinates; what is found depends on (distance, index) alone, not on the history.
/// Positions are finite, and no two points have the same. Queries may run at the same time on many
/// threads. Changes, and queries that find few points: O(log #P) on a surface; rarely a change
/// enlarges the root's cell, which takes O(#P). About 70 bytes a point.
class PointOctree {
 public:
  void insert(std::uint32_t index, const Vec3f& position, double squared_reach = 0);
  /// The point that was inserted with this index at this position goes.
  void erase(std::uint32_t index, const Vec3f& position);
  void set_reach(std::uint32_t index, const Vec3f& position, double squared_reach);

  /// The `count` points nearest to `query`, in the order of (distance, index); all where there are
  /// fewer.
  void nearest(const Vec3f& query, std::size_t count, std::vector<Neighbour>& found) const;

  /// The points at most their own reach away from `query`, in no order.
  void reaching(const Vec3f& query, std::vector<std::uint32_t>& found) const;

  std::size_t size() const { return nodes_[0].count; }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::size_t kBucket = 16;  ///< a leaf with more points is divided
  static constexpr std::size_t kFew = 8;      ///< an inner node with no more points is a leaf again

  struct Entry {
    Vec3f position;
    std::uint32_t index;
    double squared_reach;
  };
  /// What is below is known by its bounding box, its number of points and its largest reach.
  struct Node {
    Vec3f low, high;
    double squared_reach = 0;
    std::uint32_t count = 0;
    std::uint32_t below = kNone;  ///< of a leaf its bucket, otherwise the first of its children
    bool leaf = true;

    double squared_distance(const Vec3d& query) const;
  };
  /// A cube of space; sides are powers of two, so that halving rounds nothing.
  struct Cell {
    Vec3d centre;
    double half = 0;

    static Cell around(const Vec3f& low, const Vec3f& high);
    std::size_t octant(const Vec3f& p) const;
    Cell child(std::size_t octant) const;
    bool contains(const Vec3f& p) const;
  };
  struct NearestSearch;
  using Bucket = std::array<Entry, kBucket>;

  void make_room_for(const Vec3f& p);
  void collect(const Node& node, std::vector<Entry>& found) const;
  void insert_below(std::uint32_t node, const Cell& cell, const Entry& entry);
  /// Descends to the leaf that holds a position, calls `change(leaf)`, and sums up on the way back.
  template <class Change>
  void change_leaf_of(const Vec3f& p, std::uint32_t node, const Cell& cell, Change change);
  void split(std::uint32_t node, const Cell& cell);
  void collapse(std::uint32_t node);
  /// Takes a copy: the buckets may move to make room for another.
  void append(std::uint32_t leaf, Entry entry);
  void summarise(std::uint32_t node);
  std::uint32_t new_children();
  std::uint32_t new_bucket();
  std::span<Entry> entries(const Node& leaf);
  std::span<const Entry> entries(const Node& leaf) const;
  Entry& entry_of(std::uint32_t leaf, std::uint32_t index);

  void visit(const Node& node, NearestSearch& search) const;
  void visit(const Node& node, const Vec3d& query, std::vector<std::uint32_t>& found) const;

  Cell root_;
  std::vector<Node> nodes_ = std::vector<Node>(1);  ///< the root, then children in eights
  std::vector<Bucket> buckets_;
  std::vector<std::uint32_t> free_children_, free_buckets_;
};

}  // namespace burnish
