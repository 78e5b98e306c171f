#pragma once

#include <span>
#include <string>
#include <string_view>

#include "burnish/base/result.h"
#include "burnish/core/triangle_mesh.h"

// Shapes to judge smoothing by: nothing may be trained on them or chosen by them.
namespace burnish {

/// Twelve closed shapes: smooth ones, ones with sharp and with rounded edges, thin and winding
/// ones.
std::span<const std::string_view> judged_shapes();

/// One of them, 0.3 m across, of 5000 to 11000 triangles; or one of make_shape, as it
/// is. Errors: invalid_argument.
Result<TriangleMesh> judged_shape(const std::string& name);

}  // namespace burnish
