#pragma once

#include <string_view>
#include <vector>

#include "burnish/base/result.h"
#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// The channel of that name, which says of each vertex, from 0 to 1, how much an operation is to
/// take hold of it; empty where the mesh has none. Errors: bad_geometry where it is not of floats,
/// or one is not within 0 and 1.
Result<std::vector<float>> vertex_weights(const TriangleMesh& mesh, std::string_view channel);

}  // namespace burnish
