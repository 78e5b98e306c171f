#pragma once

#include <cstdint>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/large_vector.h"
#include "burnish/core/adjacency.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// The connectivity of a triangle mesh that edge collapses change. Half-edge 3 t + i runs along
/// triangle t from its corner i to the next; its twin runs along the neighbour the other way.
///
/// What is not a surface around it (a vertex on an edge of three triangles or of two that disagree
/// on the orientation, of several fans, or of a triangle that names a vertex twice) is locked: it
/// stays, and nothing is merged into it. All others are inner, or on the boundary of one fan.
class HalfEdges {
 public:
  using Index = std::uint32_t;
  static constexpr Index kNone = 0xffffffff;

  /// `triangles` name vertices below `vertices`. Where the context is cancelled nothing that it
  /// says is true. O(#V + #T).
  HalfEdges(std::size_t vertices, const std::vector<Triangle>& triangles,
            const Context& context = {});

  static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static Index previous(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }

  std::size_t triangles() const { return origin_.size() / 3; }  ///< those gone included
  std::size_t live_triangles() const { return live_; }
  bool is_live(std::size_t t) const { return origin_[3 * t] != kNone; }
  Triangle triangle(std::size_t t) const {
    return {origin_[3 * t], origin_[3 * t + 1], origin_[3 * t + 2]};
  }

  Index origin(Index h) const { return origin_[h]; }
  Index head(Index h) const { return origin_[next(h)]; }
  Index apex(Index h) const { return origin_[previous(h)]; }
  Index twin(Index h) const { return twin_[h]; }  ///< kNone along a boundary

  enum class Kind : std::uint8_t { inner, boundary, locked, gone };
  Kind kind(Index v) const { return kind_[v]; }

  /// Calls `visit(h)` for the half-edges that leave `v`, counter-clockwise; from one boundary to
  /// the other where there is one. `v` is inner or on the boundary.
  template <class Visit>
  void for_each_from(Index v, Visit visit) const {
    const Index first = out_[v];
    Index h = first;
    do {
      visit(h);
      h = twin_[previous(h)];
    } while (h != first && h != kNone);
  }

  /// Whether the triangles around the edge of `h` remain a surface of the same kind, with the same
  /// boundaries, if its two ends become one vertex (the link condition: Dey, Edelsbrunner, Guha and
  /// Nekhayev 1999), and which of the ends may go: an inner vertex, or one on the boundary along
  /// it.
  struct Merge {
    bool origin_may_go = false, head_may_go = false;
    bool possible() const { return origin_may_go || head_may_go; }
  };
  Merge ends_that_may_go(Index h) const;  ///< by their kinds alone
  bool keeps_surface(Index h);            ///< O(valence)

  /// Merges the end of `h` that goes into the other. `keeps_surface(h)` and the end may go.
  void collapse(Index h, bool head_goes);

  /// Drops the triangles that are gone, in order; half-edges are numbered anew. Returns what each
  /// triangle's number was. O(#T).
  LargeVector<Index> compact();

 private:
  static constexpr Index kAmbiguous = kNone - 1;
  bool pair_up(const Adjacency& leaving, const Context& context);
  void find_kinds(const Adjacency& leaving);

  LargeVector<Index> origin_, twin_;
  LargeVector<Index> out_;     ///< per vertex a half-edge that leaves it; the first on a boundary
  std::vector<Kind> kind_;     ///< per vertex
  std::vector<Index> marked_;  ///< per vertex the last query that met it
  Index query_ = 0;
  std::size_t live_ = 0;
};

}  // namespace burnish
