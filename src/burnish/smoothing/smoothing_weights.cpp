#include "burnish/smoothing/smoothing_weights.h"

#include "burnish/core/vertex_weights.h"

namespace burnish {

Result<std::vector<float>> smoothing_weights(const TriangleMesh& mesh) {
  return vertex_weights(mesh, kSmoothingWeight);
}

}  // namespace burnish
