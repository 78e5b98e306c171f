#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <utility>

namespace burnish {

/// Half of an edge of a subdivision of the plane; its other half is number ^ 1. Around a point the
/// edges that leave it form a ring.
struct HalfEdge {
  std::uint32_t origin;
  std::uint32_t next;      ///< in the ring of the origin, counter-clockwise
  std::uint32_t previous;  ///< clockwise
};

constexpr std::uint32_t kNoEdge = std::numeric_limits<std::uint32_t>::max();

/// Edges between points of the plane and their rings (Guibas and Stolfi 1985, without the dual).
class PlaneSubdivision {
 public:
  explicit PlaneSubdivision(std::size_t slots)
      : edges_(std::make_unique_for_overwrite<HalfEdge[]>(2 * slots)) {}

  std::uint32_t origin(std::uint32_t e) const { return edges_[e].origin; }
  std::uint32_t destination(std::uint32_t e) const { return edges_[e ^ 1].origin; }
  std::uint32_t next(std::uint32_t e) const { return edges_[e].next; }
  std::uint32_t previous(std::uint32_t e) const { return edges_[e].previous; }
  /// The edge from the destination that has the same face on its left.
  std::uint32_t left_next(std::uint32_t e) const { return edges_[e ^ 1].previous; }
  /// The edge from the destination that has the same face on its right.
  std::uint32_t right_next(std::uint32_t e) const { return edges_[e ^ 1].next; }
  /// The edge to the origin that has the same face on its right.
  std::uint32_t right_previous(std::uint32_t e) const { return edges_[e].previous ^ 1; }

  /// Makes `e` an edge that hangs together with no other.
  void make(std::uint32_t e, std::uint32_t from, std::uint32_t to) {
    edges_[e] = {from, e, e};
    edges_[e ^ 1] = {to, e ^ 1, e ^ 1};
  }
  /// Puts `e`, alone so far, into the ring of `neighbour` after it.
  void insert_after(std::uint32_t e, std::uint32_t neighbour) {
    const std::uint32_t following = edges_[neighbour].next;
    edges_[e].next = following;
    edges_[e].previous = neighbour;
    edges_[neighbour].next = e;
    edges_[following].previous = e;
  }
  /// Takes both halves of `e` out of their rings.
  void detach(std::uint32_t e) {
    for (const std::uint32_t half : {e, e ^ 1}) {
      edges_[edges_[half].previous].next = edges_[half].next;
      edges_[edges_[half].next].previous = edges_[half].previous;
    }
  }

  /// Leaves `e` without origin, as the one before `following` in a chain of removed edges.
  void clear(std::uint32_t e, std::uint32_t following) {
    edges_[e] = {kNoEdge, following, kNoEdge};
    edges_[e ^ 1] = {kNoEdge, kNoEdge, kNoEdge};
  }

  /// Marks the edges that have the outside on their left, once all is done: their rings are lost.
  void mark_outside(std::uint32_t hull) {
    for (std::uint32_t e = hull; e != kNoEdge;) {
      const std::uint32_t following = std::exchange(edges_[e ^ 1].next, kNoEdge);
      e = following == hull ? kNoEdge : following;
    }
  }
  /// Whether `e` is there and, after mark_outside(), not outside.
  bool is_inside(std::uint32_t e) const {
    return edges_[e].origin != kNoEdge && edges_[e].next != kNoEdge;
  }

 private:
  std::unique_ptr<HalfEdge[]> edges_;
};

/// The places of edges 2 * first up to 2 * end of a subdivision, handed out one by one; those of
/// removed edges are used again.
class EdgeSlots {
 public:
  EdgeSlots(PlaneSubdivision& edges, std::uint32_t first, std::uint32_t end)
      : edges_(&edges), begin_(2 * first), fresh_(2 * first), end_(2 * end) {}

  bool empty() const { return removed_ == kNoEdge && fresh_ == end_; }

  /// Undefined where there is none.
  std::uint32_t take() {
    if (removed_ == kNoEdge) return std::exchange(fresh_, fresh_ + 2);
    return std::exchange(removed_, edges_->next(removed_));
  }

  void give_back(std::uint32_t e) {
    edges_->clear(e & ~1u, removed_);
    removed_ = e & ~1u;
  }

  /// Every half-edge that was ever taken is one of these.
  std::uint32_t begin() const { return begin_; }
  std::uint32_t end() const { return fresh_; }

 private:
  PlaneSubdivision* edges_;
  std::uint32_t begin_, fresh_, end_;
  std::uint32_t removed_ = kNoEdge;  ///< the first of a chain of removed edges
};

}  // namespace burnish
