#pragma once

#include <functional>
#include <string_view>

#include "burnish/base/context.h"
#include "burnish/base/result.h"
#include "burnish/base/vec3.h"

namespace burnish {

/// Reads which points are meant, and answers for points in world coordinates:
///   "box:x0,y0,z0,x1,y1,z1", "sphere:x,y,z,radius"  as parse_region has them
///   "near:MESH,distance"  at most so far (with a unit: 5mm) from the surface in the file MESH,
///                         whose name may hold commas
/// The file is read here; the answer keeps what it needs of it, may be asked from many threads and
/// takes O(log #T). Errors: invalid_argument with the text and the forms that would do; of `near`
/// also those of read_mesh.
Result<std::function<bool(const Vec3d&)>> read_selection(std::string_view text,
                                                         const Context& context = {});

}  // namespace burnish
