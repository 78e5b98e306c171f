#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/facts.h"
#include "burnish/base/result.h"
#include "burnish/core/triangle_mesh.h"

// What all refinements share. Any triangle mesh can be refined: boundaries, non-manifold edges,
// triangles that name a vertex twice and vertices without triangles are kept as such.
//
// Old vertices keep their numbers, new ones follow. What is known of a new vertex follows from its
// parents (interpolation.h): it is marked interpolated. Triangles inherit what is known of the one
// that they are part of. Normals that are there are computed anew from the triangles. Two triangles
// along an edge have the same vertices there, before and after: no cracks, no T-junctions.
namespace burnish {

/// A channel of this name (float, 0 to 1) says where a mesh is refined: around the vertices that
/// have 1. A triangle with such a corner is refined as elsewhere, one without is only cut where its
/// neighbours need that, and no old vertex but those moves. A new vertex has 1 where all its
/// parents have: from pass to pass the zone gets smaller at its border, and triangles larger from
/// there outwards. Without the channel all is refined.
inline constexpr std::string_view kRefinement = "refinement";

/// Where a mesh is refined, as its channel says.
class RefinementZone {
 public:
  /// Errors: bad_geometry where the channel is not of floats from 0 to 1.
  static Result<RefinementZone> of(const TriangleMesh& mesh);

  bool has(std::uint32_t vertex) const { return weights_.empty() || weights_[vertex] >= 1; }
  bool touches(const Triangle& t) const { return has(t[0]) || has(t[1]) || has(t[2]); }

 private:
  std::vector<float> weights_;
};

/// What a refinement did.
struct RefinementReport {
  std::size_t new_vertices = 0;
  std::size_t new_triangles = 0;   ///< more than there were
  std::size_t moved_vertices = 0;  ///< old ones that are not where they were
  double max_move = 0;             ///< of those, m
  double longest_edge = 0;         ///< now, m

  Facts facts() const;
};

/// The report on what became of `before`.
RefinementReport report_refinement(const TriangleMesh& before, const TriangleMesh& after);

/// Whether a mesh of so many vertices and triangles can be: both are numbered with 32 bits, the
/// sides of triangles too. Errors: invalid_argument.
Result<void> check_refined_size(double vertices, double triangles);

/// A refinement that goes over the whole mesh, and again over what came of it.
struct RefinementPasses {
  int count = 1;
  int growth = 4;  ///< at most so many triangles come of one in a pass
  /// One pass, the `index`-th; false where the context was cancelled.
  std::function<bool(TriangleMesh& mesh, const RefinementZone&, int index, const Context&)> run;
};

/// Runs the passes on a copy of `mesh`, which takes the result's place. Errors: invalid_argument
/// where the result would be too large, bad_geometry, cancelled; `mesh` is then unchanged.
Result<RefinementReport> refine_in_passes(TriangleMesh& mesh, const RefinementPasses& passes,
                                          const Context& context);

}  // namespace burnish
