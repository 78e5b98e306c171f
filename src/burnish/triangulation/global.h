#pragma once

#include "burnish/base/context.h"
#include "burnish/base/schema.h"
#include "burnish/core/point_cloud.h"
#include "burnish/triangulation/triangulation.h"

namespace burnish {

/// How a surface is put together from the fans' triangles.
enum class Agreement { vote, front };

struct GlobalParams {
  Agreement agreement = Agreement::vote;
  int neighbours = 16;
  int most_neighbours = 96;
  double sheet_angle = 1.5707963267948966;  // 90 degrees
  double max_gap = 1.5;
  int hole_edges = 12;

  static const Schema<GlobalParams>& schema();
};

/// One surface through all the points, from fans that agree, after the global triangulation of
/// Linsen and Prautzsch 2001 (as told there; details are our own). Every point has a fan: its star
/// in the Delaunay triangulation of its nearest neighbours in its tangent plane (local_fans.h).
/// `vote`: triangles that the fans of all three corners hold are taken first, then those of two,
/// then of one, well shaped ones first, each only where it is joined to the surface and this stays
/// an orientable manifold. `front`: the surface grows from a seed edge by edge (front.h). Then
/// boundary loops of at most `hole_edges` edges are closed by the triangulation of best shape;
/// these triangles have the origin `invented`.
///
/// Normals are used where the cloud has them and are estimated otherwise (surface_normals.h); they
/// tell two sheets apart that are nearer than the sampling. No triangle spans a gap of the
/// sampling: no point of it is farther from its nearest corner than `max_gap` times the largest of
/// its corners' median edges; those that close a hole may span a third more, by default two edges.
/// Pieces of at most twelve vertices that did not fit into the surface beside them are left out.
///
/// The result: no edge with three triangles, no vertex with two fans, one orientation, along the
/// normals. Points without a place in it and all but one of coincident points are left out;
/// attributes are carried. The triangles do not depend on the order of the points as long as the
/// normals do not. O(#P log #P); missing pixels of an organized cloud are skipped.
/// Errors: invalid_argument, bad_geometry, cancelled.
Result<Triangulation> triangulate_global(const PointCloud& cloud, const GlobalParams& params = {},
                                         const Context& context = {});

}  // namespace burnish
