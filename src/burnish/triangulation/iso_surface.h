#pragma once

#include "burnish/core/triangle_mesh.h"
#include "burnish/triangulation/distance_volume.h"

namespace burnish {

/// The surface on which a volume's distance is zero: a vertex for each loop in which the surface
/// crosses the edges of a cube of eight voxels, two triangles for each edge that it crosses. This
/// is the dual of marching cubes (Lorensen and Cline 1987; Nielson 2004): fewer vertices,
/// triangles of nearly one size instead of slivers, and each vertex is the mean of the crossings of
/// its loop (Gibson 1998).
///
/// Cubes count all of whose corners were seen, measured or empty. An edge is crossed where it goes
/// from a measured voxel behind the surface to a measured or an empty one in front, and the
/// distance does not change by more along it than the edge's length and the noise allow: what is
/// more is an outline, beyond which nothing was seen. So the surface ends where it was not seen,
/// and no triangle closes a gap. Crossings keep a 32nd of a voxel from the voxels, so that no two
/// vertices coincide.
///
/// Every edge has one or two triangles, all oriented alike, towards the front; around gaps patches
/// may touch in a vertex. Attributes: normals (of the triangles around, by area), observations (the
/// fewest frames that measured a voxel of a crossing), origin (seen; interpolated where a voxel in
/// front was empty and not measured), and sigma: 1 / sqrt of the mean weight, times what averaging
/// neighbouring patches of pixels leaves of noise correlated as core/noise_correlation.h says.
/// No noise: sums keep the deviation across the surface and not how it lies to the rays.
///
/// In the order of the blocks' places; the same bytes for any number of threads. Errors: cancelled.
/// O(#blocks + #T), 2 kB for every block that the surface passes through.
Result<TriangleMesh> iso_surface(const DistanceVolume& volume, int min_observations = 1,
                                 const Context& context = {});

}  // namespace burnish
