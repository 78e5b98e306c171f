#pragma once

#include <string_view>
#include <vector>

#include "burnish/base/result.h"
#include "burnish/smoothing/smoothing.h"

namespace burnish {

/// A channel of this name (float, 0 to 1) says of each vertex how far it follows a smoothing: 0
/// pins it, 1 leaves it free, 0.3 lets it make three tenths of every move. Every smoothing heeds
/// it, and none changes it.
inline constexpr std::string_view kSmoothingWeight = "smoothing_weight";

/// The values of that channel; empty where the mesh has none: all are free. Errors: bad_geometry
/// where it is not of floats, or one is not within 0 and 1.
Result<std::vector<float>> smoothing_weights(const TriangleMesh& mesh);

}  // namespace burnish
