#pragma once

#include <optional>
#include <span>
#include <vector>

#include "burnish/adaptation/blend.h"
#include "burnish/adaptation/interpolation.h"
#include "burnish/adaptation/refinement.h"
#include "burnish/core/edge_table.h"

namespace burnish {

/// No vertex: on an edge that is not cut.
inline constexpr std::uint32_t kNoVertex = ~0u;

/// A mesh's triangles cut in four by new vertices on their edges; where those lie is left to the
/// method. The edges of all triangles that the zone touches are cut, but
/// for those of a closed surface of two triangles, which would become non-manifold. A triangle all
/// of whose edges are cut becomes four, one with two cut edges three (by the shorter diagonal of
/// what is left), one with one cut edge two: so triangles around the zone fit it.
struct Quadrisection {
  EdgeTable edges;
  std::vector<std::uint32_t> vertex_of_edge;  ///< the number of the new vertex, or kNoVertex
  std::vector<Parents<2>> parents;            ///< of the new vertices, the ends of their edges
};

/// O(#T log valence). Nothing where the context was cancelled.
std::optional<Quadrisection> plan_quadrisection(const TriangleMesh& mesh,
                                                const RefinementZone& zone, const Context& context);

/// Cuts the triangles of `mesh` and puts its vertices where `placement` says. False where the
/// context was cancelled; `mesh` is then of no meaning. A triangle that names a vertex twice
/// becomes four such. O(#T).
bool quadrisect(TriangleMesh& mesh, const Quadrisection& plan, Placement placement,
                const Context& context);

}  // namespace burnish
