#pragma once

#include <cstdint>
#include <vector>

#include "burnish/base/context.h"
#include "burnish/base/facts.h"
#include "burnish/base/result.h"
#include "burnish/core/point_cloud.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// Unsigned distances of many points from a surface, m.
struct Distances {
  std::size_t count = 0;
  double rms = 0, mean = 0;
  double p95 = 0;  ///< 95 % are at most this
  double max = 0;

  Facts facts() const;
};

struct TruthParams {
  int samples = 200000;  ///< on each surface; 1 to 100 million
};

/// How far a mesh is from the surface that it should be.
struct TruthComparison {
  Distances to_truth;    ///< from points spread evenly over the mesh to the truth
  Distances vertices;    ///< from the mesh's vertices to the truth
  Distances from_truth;  ///< from points spread evenly over the truth to the mesh
  double mean_normal_error =
      0;  ///< between the normals of the mesh and of the nearest true triangle,
          ///< over the mesh's samples, rad; above pi/2 where folded

  std::vector<float> deviation;  ///< of each vertex of the mesh from the truth, unsigned, m

  /// The larger of both ways' maxima, vertices included, m.
  double hausdorff() const;
  Facts facts() const;
};

/// Both meshes in the same frame of coordinates (different Frame origins are taken into account).
/// Samples are stratified by area and the same at every call (Metro, Cignoni et al. 1998, samples
/// the surfaces too); distances are exact. A partial scan is near the truth, the truth far from the
/// scan: look at both ways. Errors: bad_geometry (also for a mesh without area), cancelled. O((#V +
/// samples) log #T).
Result<TruthComparison> compare_to_truth(const TriangleMesh& mesh, const TriangleMesh& truth,
                                         const TruthParams& params = {},
                                         const Context& context = {});

/// The distances of all points of a cloud (missing pixels left out) from the truth: what the raw
/// measurements are, to be compared with TruthComparison::vertices.
/// Errors: bad_geometry, cancelled.
Result<Distances> compare_to_truth(const PointCloud& cloud, const TriangleMesh& truth,
                                   const Context& context = {});

}  // namespace burnish
