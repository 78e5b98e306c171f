#pragma once

#include <vector>

#include "burnish/base/result.h"
#include "burnish/core/triangle_mesh.h"
#include "burnish/pipeline/region.h"

namespace burnish {

/// How far each vertex follows a smoothing that is confined to `region` (world coordinates): as far
/// as the mesh's own channel smoothing_weight says inside (1 where there is none), and 0 outside.
/// Errors: bad_geometry where the channel cannot be; invalid_argument where no vertex is inside.
Result<std::vector<float>> weights_inside(const TriangleMesh& mesh, const Region& region);

/// While it lives, the mesh's channel smoothing_weight holds `weights`; then it is as it was
/// before, or is gone where there was none.
class TemporaryWeights {
 public:
  TemporaryWeights(TriangleMesh& mesh, std::vector<float> weights);
  ~TemporaryWeights();
  TemporaryWeights(const TemporaryWeights&) = delete;
  TemporaryWeights& operator=(const TemporaryWeights&) = delete;

 private:
  TriangleMesh& mesh_;
  std::vector<Channel> before_;  ///< one or none
};

}  // namespace burnish
