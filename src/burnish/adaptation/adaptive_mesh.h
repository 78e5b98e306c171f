#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "burnish/adaptation/removal_order.h"

namespace burnish {

/// Says of a point in world coordinates whether it is meant. It is asked from several threads.
using PointTest = std::function<bool(const Vec3d&)>;

/// How fine a mesh is to be inside a region and outside of it.
struct Focus {
  std::optional<double> inside_error{};  ///< m; none: every vertex of the original is there
  double outside_error = std::numeric_limits<double>::infinity();  ///< m
  std::size_t outside_triangles = 0;  ///< vertices outside go until at most so many triangles have
                                      ///< no corner inside
};

/// A mesh whose vertices go and come back, in regions and in numbers, for ever.
///
/// It is made of a mesh and a log of removals, and is always the original with some of them made: a
/// set that holds, with each removal, all that must come before it (RemovalOrder). Each such set is
/// a surface homeomorphic to the original: edge-manifold where that is, with its orientation, Euler
/// number and boundary loops, without triangles that are degenerate or double where it has none.
/// What a set looks like depends on it alone, not on the way to it. Vertices never move and
/// triangles keep their order, so that, all vertices back, the mesh is the original, bit for bit.
///
/// Refinement brings a vertex back with all that were removed on top of it, be they in the region
/// or not; reduction removes a vertex only where all that must go before it are gone, or go with
/// it. So a region is always as fine as asked, and what is around it may be finer than asked.
///
/// A call costs what it changes (a removal made or undone: its star) and one walk over the log, for
/// regions with a question a vertex; focus() begins from the original. About 70 bytes a vertex
/// besides the mesh.
class AdaptiveMesh {
 public:
  /// The original, all vertices there. Vertices that the log does not name stay, among them those
  /// that no triangle uses. Errors: those of check(mesh) and RemovalOrder::make.
  static Result<AdaptiveMesh> make(TriangleMesh original, std::span<const Removal> log,
                                   const Context& context = {});

  // The whole mesh.

  /// Every vertex is there.
  void restore() { to_removals(0); }
  /// The removals with an error up to `error`, m, are made, no others: the log's beginning.
  void to_error(double error);
  /// The shortest beginning of the log is made that leaves at most so many triangles; the whole log
  /// where none does.
  void to_triangles(std::size_t count);
  /// The first `count` removals are made, no others; all where there are fewer.
  void to_removals(std::size_t count);

  // Regions. A vertex lies where it was when it was removed. Errors: cancelled, with nothing
  // changed: the questions to `where` can be cancelled, what follows takes about 70 ns a removal.

  /// Undoes the removals in the region whose error is more than `error`, all of them by default.
  Result<void> refine(const PointTest& where, const Context& context = {});
  Result<void> refine_to_error(const PointTest& where, double error, const Context& context = {});
  /// Makes all removals in the region, or those with an error up to `error`.
  Result<void> reduce(const PointTest& where, const Context& context = {});
  Result<void> reduce_to_error(const PointTest& where, double error, const Context& context = {});
  /// Inside fine and outside coarse, whatever was before: along the log, each removal is made
  /// that the focus allows and whose prerequisites were.
  Result<void> focus(const PointTest& where, const Focus& focus, const Context& context = {});

  // What it is now.

  std::size_t triangle_count() const { return triangle_count_; }
  std::size_t vertex_count() const { return original_.positions.size() - removed_count_; }
  std::size_t removed_count() const { return removed_count_; }
  bool removed(std::uint32_t removal) const { return states_[removal] != State::open; }
  std::span<const Removal> log() const { return log_; }
  /// The largest error of a removal that is made, m; 0 where none is.
  double error() const;

  /// The vertices that are not removed and the triangles that are left, both in the original's
  /// order, with their attributes. The owner of a triangle, once removed, is the vertex that it
  /// went into. O(#V + #T of the original).
  TriangleMesh mesh() const;
  /// Per vertex of mesh() its number in the original.
  std::vector<std::uint32_t> vertices() const;

  // Editing a coarse level. There are two ways back. Exact: a vertex comes back where it was, bit
  // for bit; so it is at first. With its detail: it comes back where it was as seen from the
  // triangles that are there without it (offset from the vertex it went into, in a frame of their
  // mean normal and an edge), so that it follows when they were moved, turned or bent. Where
  // nothing was moved that is its place to within the rounding of float. Where those triangles have
  // no area, the offset keeps its direction in space.

  /// From now on vertices come back with their detail: those that are removed, as of where they
  /// are now, and each that will be, as of when it is. Call it before an edit. O(#V + #T) the first
  /// time, then nothing; 24 bytes a removal.
  void remember_detail();
  /// From now on vertices come back where they last were.
  void forget_detail();
  bool remembers_detail() const { return !details_.empty(); }

  /// Moves the vertices of mesh(), in its order. Normals, where the original has them, are then
  /// computed anew by mesh(); other attributes stay. Errors: invalid_argument (another number of
  /// positions), bad_geometry (one that is not finite); nothing is changed then.
  Result<void> set_positions(std::span<const Vec3f> positions);

 private:
  enum class State : std::uint8_t { open, made, to_undo };
  using Mask = std::vector<std::uint8_t>;

  AdaptiveMesh() = default;

  Result<Mask> mask(const PointTest& where, const Context& context) const;
  template <class Wanted>
  void undo_with_above(Wanted wanted);
  template <class Wanted>
  void make_where(Wanted wanted);
  bool can_be_made(std::uint32_t removal) const;
  void make_removal(std::uint32_t removal);
  void undo_removal(std::uint32_t removal);
  std::vector<std::uint32_t> representatives() const;

  TriangleMesh original_;  ///< its triangles name the vertices that they have now
  std::vector<Removal> log_;
  RemovalOrder order_;
  std::vector<State> states_;   ///< per removal
  std::vector<bool> gone_;      ///< per triangle
  std::vector<Vec3d> details_;  ///< per removal, m; empty: vertices come back where they were
  std::size_t triangle_count_ = 0, removed_count_ = 0;
  bool edited_ = false;  ///< positions were set
};

}  // namespace burnish
