#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// Triangles that change, and for each vertex the list of the corners at it, the latest first.
/// Corner 3 t + k is the k-th of triangle t.
class TriangleStars {
 public:
  /// The corners at one vertex.
  class Corners;

  void reserve(std::size_t vertices, std::size_t triangles);
  void add_vertex() { first_.push_back(kEnd); }
  /// Its vertices must have been added.
  void add_triangle(const Triangle& triangle);

  std::size_t vertices() const { return first_.size(); }
  std::size_t triangles() const { return triangles_.size(); }
  const Triangle& triangle(std::uint32_t t) const { return triangles_[t].vertices; }
  std::uint32_t vertex_at(std::uint32_t corner) const {
    return triangles_[corner / 3].vertices[corner % 3];
  }
  Corners corners_at(std::uint32_t vertex) const;

  /// Takes a corner off the list of its vertex. O(valence).
  void take(std::uint32_t corner);
  /// Names the vertex of a corner that is on no list, and puts it at the head of that vertex's.
  void put(std::uint32_t corner, std::uint32_t vertex);
  /// Has the corners at `from` whose `moves` is 1, of 0 and 1, name `to`, which has no corner yet,
  /// and takes them to its list, in their order. O(valence).
  void move(std::uint32_t from, std::uint32_t to, std::span<const std::uint8_t> moves);

 private:
  static constexpr std::uint32_t kEnd = ~0u;

  /// Beside each other, since whoever goes along a list looks at the triangles too.
  struct Linked {
    Triangle vertices;
    std::array<std::uint32_t, 3> next;  ///< corner on the list of each vertex, or kEnd
  };
  std::uint32_t& next_of(std::uint32_t corner) { return triangles_[corner / 3].next[corner % 3]; }

  std::vector<Linked> triangles_;
  std::vector<std::uint32_t> first_;  ///< corner at each vertex, or kEnd
};

class TriangleStars::Corners {
 public:
  class Iterator {
   public:
    Iterator(const TriangleStars& stars, std::uint32_t corner) : stars_(&stars), corner_(corner) {}
    std::uint32_t operator*() const { return corner_; }
    Iterator& operator++() {
      corner_ = stars_->triangles_[corner_ / 3].next[corner_ % 3];
      return *this;
    }
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.corner_ == b.corner_; }

   private:
    const TriangleStars* stars_;
    std::uint32_t corner_;
  };

  Corners(const TriangleStars& stars, std::uint32_t first) : stars_(stars), first_(first) {}
  Iterator begin() const { return {stars_, first_}; }
  Iterator end() const { return {stars_, kEnd}; }

 private:
  const TriangleStars& stars_;
  std::uint32_t first_;
};

inline TriangleStars::Corners TriangleStars::corners_at(std::uint32_t vertex) const {
  return {*this, first_[vertex]};
}

}  // namespace burnish
