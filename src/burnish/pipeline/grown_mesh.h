#pragma once

#include <cstdint>
#include <vector>

#include "burnish/base/result.h"
#include "burnish/core/triangle_mesh.h"
#include "burnish/pipeline/growing_mesh.h"
#include "burnish/pipeline/progressive_columns.h"

namespace burnish {

/// A mesh as it was read from a progressive file, vertices and triangles as they came.
struct GrownMesh {
  GrowingMesh mesh;
  ProgressiveColumns columns;                 ///< of its vertices
  std::vector<Origin> triangle_origin;        ///< of its triangles, or empty
  std::vector<std::uint32_t> triangle_owner;  ///< likewise, in numbers of the original
};

struct OrderedMesh {
  TriangleMesh mesh;
  std::vector<std::uint32_t> places;  ///< where each vertex as it came is in `mesh`
};

/// The mesh in the order of the original. Owners are kept where `whole`: where all vertices of the
/// original are there. Errors: bad_file where two vertices or triangles are the same one of the
/// original. Memory besides the result at most 40 bytes a triangle.
Result<OrderedMesh> in_original_order(GrownMesh grown, bool whole);

}  // namespace burnish
