#pragma once

#include <vector>

#include "burnish/core/triangle_mesh.h"

namespace burnish {

/// The Utah teapot (Newell 1975) from its 32 bicubic Bezier patches with the bottom, z upwards,
/// unscaled: 6.43 long from the handle to the spout's tip, 3.15 high. Each patch is cut into
/// cells_per_patch x cells_per_patch squares of two triangles; triangles that the poles of the lid
/// and the bottom make degenerate are left out, and equal points are one vertex. At
/// least 2 cells: with one, the halves of handle and spout would be flat.
///
/// With 6 cells this is the model of Ozbay and Cinar: 1177 vertices, 2256 triangles. The surface is
/// oriented outwards but, as Newell's is, not closed: the lid lies loose in the rim, handle and
/// spout end open inside the body, and one end of the handle touches the body in a single vertex.
TriangleMesh make_teapot(int cells_per_patch = 6);

/// The positions of make_teapot before they are rounded to float.
std::vector<Vec3d> teapot_points(int cells_per_patch = 6);

}  // namespace burnish
