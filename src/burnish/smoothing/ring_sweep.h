#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "burnish/core/adjacency.h"
#include "burnish/smoothing/tile_order.h"

// How the smoothings that make many passes over one-rings go through memory. Not part of the
// library's interface.
namespace burnish {

/// Whether passes over rings with so many neighbours in all are a few milliseconds of work: to wake
/// other threads would cost more than they save. `effort` is that of a visit, 1 for a plain mean.
inline bool is_little_work(std::size_t neighbours, int passes, double effort = 1) {
  return static_cast<double>(neighbours) * passes * effort < 4e6;
}

/// What the vertices are called while passes go over them.
enum class Numbering {
  as_given,  ///< as in the mesh
  near,      ///< anew where that pays: neighbours near to each other, alike rings side by side
};

struct SweepLayout {
  Numbering numbering = Numbering::near;
  unsigned tile_bits = 11;                   ///< 2^11 vertices are taken together
  std::size_t cache = std::size_t{8} << 20;  ///< bytes that stay in the processor's caches
  double effort = 1;  ///< of a visit to a vertex, in visits of the plain mean
};

/// Rings of vertices that are taken together.
class RingTile {
 public:
  /// Neighbouring vertices whose rings are of one length.
  struct Run {
    std::uint32_t end, length;
  };

  RingTile(std::uint32_t begin, std::uint32_t end, const Run* runs, const std::uint32_t* items)
      : begin_(begin), end_(end), runs_(runs), items_(items) {}
  RingTile(std::uint32_t begin, std::uint32_t end, const Adjacency& rings)
      : begin_(begin), end_(end), rings_(&rings) {}

  /// Calls `visit(v, ring)` for each of its vertices.
  template <class Visit>
  void for_each(Visit visit) const {
    if (rings_) {
      for (std::uint32_t v = begin_; v < end_; ++v) visit(v, rings_->row(v));
      return;
    }
    const std::uint32_t* items = items_;
    std::uint32_t v = begin_;
    for (const Run* run = runs_; v < end_; ++run) {
      const Run here = *run;
      for (; v < here.end; ++v, items += here.length) visit(v, std::span(items, here.length));
    }
  }

 private:
  std::uint32_t begin_, end_;
  const Run* runs_ = nullptr;
  const std::uint32_t* items_ = nullptr;
  const Adjacency* rings_ = nullptr;  ///< in place of runs and items
};

/// The one-rings of a mesh in the order in which passes go over them. A pass takes 2 to 3 ns a
/// vertex where three things hold, and several times that where they do not:
/// - What it reads is in the processor's caches. So several passes go through memory as one wave
///   (parallel_passes), each as close behind the one before as the rings allow. Tiles come in
///   breadth-first order where the mesh's own leads far away, and all vertices do where that does
///   not help.
/// - The processor can foretell how long the next ring is. So those of a tile are sorted by length.
/// - Rings are read one behind the other.
/// The neighbours in a ring keep the order that they have in the mesh, so that sums over them are
/// the same to the last bit as those of a plain loop over the mesh's vertices.
class RingSweep {
 public:
  /// Makes ready for that many passes. False where the context was cancelled. O(#V + #T).
  [[nodiscard]] bool lay_out(const Context& context, Adjacency rings, int passes,
                             const SweepLayout& layout = {});

  std::size_t size() const { return tiling_.vertices; }
  std::size_t longest_ring() const { return longest_; }

  /// The number in the mesh of the sweep's vertex v.
  std::size_t in_mesh(std::size_t v) const { return order_.empty() ? v : order_[v]; }

  /// Values of the mesh's vertices in the sweep's numbering; none where there are none.
  template <class T>
  std::vector<T> taken_over(const std::vector<T>& values) const {
    std::vector<T> taken(values.size());
    for (std::size_t v = 0; v < taken.size(); ++v) taken[v] = values[in_mesh(v)];
    return taken;
  }
  /// And the other way.
  template <class T>
  std::vector<T> given_back(const std::vector<T>& values) const {
    std::vector<T> given(values.size());
    for (std::size_t v = 0; v < given.size(); ++v) given[in_mesh(v)] = values[v];
    return given;
  }

  /// Calls `body(pass, tile)` for every pass below `passes` and tile. What it reads at other
  /// vertices must be at those of the rings and from the pass before; what it writes must be at the
  /// tile's own vertices, and what that overwrites must be read last by their rings in the pass
  /// before: two arrays that change roles are enough. False where the context was cancelled.
  [[nodiscard]] bool run(const Context& context, int passes,
                         const std::function<void(int, const RingTile&)>& body) const;

 private:
  double bytes_per_vertex() const;
  double bytes_apart() const;
  std::size_t ring_items() const { return std::max(rings_.items().size(), items_.size()); }
  [[nodiscard]] bool number_anew(const Context& context, double cache, int passes);
  [[nodiscard]] bool sort_tiles(const Context& context);

  Tiling tiling_;
  std::size_t longest_ = 0;
  double effort_ = 1;
  int together_ = 1;                  ///< passes that make up one wave
  std::vector<std::uint32_t> needs_;  ///< per tile, for parallel_passes
  Adjacency rings_;                   ///< in the mesh's numbering, or none
  LargeVector<std::uint32_t> order_;
  std::vector<std::size_t> first_item_;           ///< per tile, in `items_`
  std::vector<std::vector<RingTile::Run>> runs_;  ///< per tile
  LargeVector<std::uint32_t> items_;
};

}  // namespace burnish
