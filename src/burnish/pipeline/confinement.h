#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "burnish/base/result.h"
#include "burnish/core/triangle_mesh.h"
#include "burnish/pipeline/region.h"

namespace burnish {

/// Per vertex whether it lies in `region` (world coordinates). Errors: invalid_argument where none
/// does.
Result<std::vector<bool>> vertices_inside(const TriangleMesh& mesh, const Region& region);

/// Per vertex whether it is a corner of a triangle that has a point in `region`, which may be
/// smaller than the triangle. Errors: invalid_argument where no triangle has.
Result<std::vector<bool>> corners_of_triangles_in(const TriangleMesh& mesh, const Region& region);

/// What an operation that heeds the vertex weights in `channel` is to heed where it is confined to
/// some vertices: at those the mesh's own weights (1 where it has none), 0 at the others. Errors:
/// bad_geometry where the channel cannot be.
Result<std::vector<float>> confined_weights(const TriangleMesh& mesh, std::string_view channel,
                                            const std::vector<bool>& inside);

/// While it lives, the mesh's channel of that name holds `weights`. Then it is what it was before,
/// if there was one: under another name it was part of whatever was done to the mesh meanwhile.
class TemporaryWeights {
 public:
  TemporaryWeights(TriangleMesh& mesh, std::string_view channel, std::vector<float> weights);
  ~TemporaryWeights();
  TemporaryWeights(const TemporaryWeights&) = delete;
  TemporaryWeights& operator=(const TemporaryWeights&) = delete;

 private:
  TriangleMesh& mesh_;
  std::string channel_, set_aside_;
};

}  // namespace burnish
