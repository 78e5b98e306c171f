#pragma once

#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "burnish/adaptation/deviation_bound.h"
#include "burnish/adaptation/half_edges.h"
#include "burnish/adaptation/quadric.h"
#include "burnish/adaptation/removal.h"
#include "burnish/adaptation/simplification.h"
#include "burnish/base/context.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// Whether `mesh` is sound and its half-edges can be numbered with 32 bits. Errors: bad_geometry,
/// unsupported.
Result<void> check_decimated(const TriangleMesh& mesh);

/// Edge collapses in rounds: costs of all edges in parallel, then the cheapest, one after the
/// other.
class Decimation {
 public:
  /// `bound`: every collapse must be accepted by it.
  Decimation(const TriangleMesh& mesh, Placement placement, std::optional<DeviationBound> bound,
             const Context& context);

  /// Collapses edges, cheapest first, until at most `target` triangles are left (a triangle less
  /// where the last collapse takes two) or none can go. What is cheapest comes from a sample: where
  /// many costs are the same a round may take all of them. Errors: cancelled. O(#T log #T) where no
  /// vertex has many triangles; a collapse takes as long as its ends have triangles.
  Result<void> run(std::size_t target, const Context& context);

  /// The same with the bound that there is, raised step by step from next to nothing: what can go
  /// without harm goes before what cannot, so that the errors of the removals rise slowly.
  Result<void> run_by_error(std::size_t target, const Context& context);

  std::size_t triangles() const { return half_edges_.live_triangles(); }
  /// In the order in which they were made. The error is that of the bound, 0 where there is none.
  const std::vector<Removal>& removals() const { return removals_; }
  /// How far the surface may be from the original, m; nothing where no bound is kept.
  std::optional<double> largest_error() const {
    return bound_ ? std::optional(bound_->largest()) : std::nullopt;
  }
  std::vector<Removal> take_removals() { return std::move(removals_); }
  /// Per removal how far along the edge, from `into` to `vertex`, their new place is: 0 to 1.
  const std::vector<float>& shares() const { return shares_; }

  const LargeVector<Vec3f>& positions() const { return positions_; }  ///< per vertex of the mesh
  /// The triangles left, as numbers of the mesh's own and with the vertices that they have now.
  const LargeVector<std::uint32_t>& numbers() const { return numbers_; }
  std::vector<Triangle> triangles_left() const;

 private:
  using Index = HalfEdges::Index;
  struct End {
    double cost;
    bool head_goes;
  };
  /// The cost of an edge that could not collapse as things were around it.
  static constexpr float kHindered = -1;
  /// The cost of what can never collapse, or is no edge of its own.
  static constexpr float kNever = std::numeric_limits<float>::infinity();

  struct Choice {
    float cost;
    Index edge;
  };

  void add_triangle_quadrics(const TriangleMesh& mesh);
  bool places_freely(Index h) const;
  End end_that_goes(Index h) const;
  float cost_of(Index h) const;
  bool find_costs(const Context& context);
  float cost_of_cheapest(std::size_t count) const;
  bool renew_costs(std::span<const Index> edges, const Context& context);
  Result<std::vector<Choice>> cheapest(float limit, const Context& context);
  void join_costs(Index collapsing);
  Quadric quadric_of(Index h, Vec3d& area, double& volume) const;
  struct Place {
    Vec3f position;
    float cost;
  };
  Place place_keeping_volume(Index h) const;
  Quadric quadric_after(Index stays, const Quadric& remembered) const;
  bool folds(const Collapse& collapse) const;
  bool folds_around(Index v, Index other, const Vec3d& moved_to) const;
  void collapse_all(const std::vector<Choice>& chosen, float limit, std::size_t target,
                    const Context& context);
  /// What became of an edge that was to collapse.
  enum class Try { made, hindered, dearer };
  Try try_collapse(Index h, float limit);
  bool is_beyond_step(Index h) const;
  bool make_if_allowed(const Collapse& collapse);
  void make(const Collapse& collapse);
  void compact();
  Vec3d place(Index v) const { return static_cast<Vec3d>(positions_[v]); }

  HalfEdges half_edges_;
  Placement placement_;
  std::optional<DeviationBound> bound_;
  Vec3d centre_;         ///< what quadrics are measured from, so that little cancels
  double diagonal_ = 0;  ///< of the box around the mesh, m
  double step_ = std::numeric_limits<double>::infinity();  ///< what the bound is raised to, m
  LargeVector<Vec3f> positions_;                           ///< per vertex
  LargeVector<Quadric> quadrics_;                          ///< per vertex
  LargeVector<float> costs_;         ///< per half-edge; of an edge at the smaller of its two
  LargeVector<std::uint8_t> stale_;  ///< per half-edge whether its cost is that of before a merge
  std::vector<std::uint8_t> state_;  ///< per vertex what became of it in this round
  LargeVector<std::uint32_t> numbers_;  ///< per triangle what the mesh calls it
  std::vector<Removal> removals_;
  std::vector<float> shares_;
};

}  // namespace burnish
