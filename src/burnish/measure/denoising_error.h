#pragma once

#include <optional>

#include "burnish/base/context.h"
#include "burnish/base/facts.h"
#include "burnish/base/result.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// What is left of the noise of a mesh. E_a rewards normals alone, and a method that gets them
/// right can fold triangles and leave the surface: read all of it together.
struct DenoisingError {
  std::size_t triangles = 0;  ///< that were compared
  double normal_error = 0;    ///< E_a: mean angle between corresponding triangles' normals, rad
  std::size_t flipped_triangles = 0;    ///< turned by more than pi / 2
  std::size_t collapsed_triangles = 0;  ///< without an area, but not in the truth; normal_error
                                        ///< counts them as pi / 2
  double vertex_error = 0;              ///< E_v, m
  double vertex_error_in_edges = 0;     ///< in mean edge lengths of the truth, or of the mesh
                                        ///< where its triangles are not those of the truth
  double vertex_error_permille = 0;     ///< in thousandths of the diagonal of the truth's box
  std::optional<double> volume_change;  ///< volume / true volume - 1, of closed and oriented meshes

  double flipped_share() const {
    return static_cast<double>(flipped_triangles) / static_cast<double>(triangles);
  }
  Facts facts() const;
};

/// Whether the meshes have equally many vertices and the same triangles, number by number: whether
/// compare_denoised can compare them. O(#T).
bool correspond(const TriangleMesh& a, const TriangleMesh& b);

/// Of a mesh whose vertices and triangles are those of the truth, moved.
///
/// E_a is the mean over triangles, each counted once whatever its area; those without an area in
/// the truth are left out. E_v (Sun, Rosin, Martin and Langbein 2007, section 5) is the root mean
/// square of the vertices' distances from the true surface, each weighted by the area of its
/// triangles in `mesh`:
///   E_v^2 = sum_i sum_{k around i} A_k dist(p_i, truth)^2 / (3 sum_k A_k).
///
/// Both meshes in the same frame of coordinates (different Frame origins are taken into account).
/// Errors: bad_geometry (also for a mesh without area, and where the triangles do not correspond),
/// cancelled. O(#V log #T).
Result<DenoisingError> compare_denoised(const TriangleMesh& mesh, const TriangleMesh& truth,
                                        const Context& context = {});

/// The same of any mesh, as of a scan: to each triangle corresponds that of the truth which is
/// nearest to its centroid. Where sheets lie nearer to each other than the noise reaches, the wrong
/// one is taken. Errors: bad_geometry (also for a mesh without area), cancelled.
/// O((#V + #T) log #T).
Result<DenoisingError> compare_to_nearest(const TriangleMesh& mesh, const TriangleMesh& truth,
                                          const Context& context = {});

}  // namespace burnish
