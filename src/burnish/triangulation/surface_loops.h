#pragma once

#include <array>
#include <cstdint>

namespace burnish {

// How a surface passes through a cube of eight voxels. Corner x + 2 y + 4 z; bit c of a mask:
// corner c is inside. Edge 4 * axis + b + 2 c runs along `axis` where the coordinates along the
// next two axes (in turn) are b and c. Face 2 * axis + side.

/// The loops in which the surface crosses a cube's edges.
struct SurfaceLoops {
  std::array<std::int8_t, 12> of_edge;  ///< -1: the surface does not cross it
  int count = 0;                        ///< at most 4
};

/// The corner at the beginning of an edge; its end is further by 1, 2 or 4 along axis 0, 1 or 2.
constexpr int edge_begin(int edge) {
  const int axis = edge / 4, b = edge % 4 & 1, c = edge % 4 >> 1;
  return b << (axis + 1) % 3 | c << (axis + 2) % 3;
}

/// Joins the crossed edges across the faces (Lorensen and Cline 1987; here by tracing faces instead
/// of a table of cases). Where all four edges of a face are crossed, the two at each inside corner
/// belong together, or, on faces in `turned` (a bit for each), the two at each outside corner.
SurfaceLoops surface_loops(unsigned mask, unsigned turned = 0);

/// The faces (a bit for each) that one loop crosses in two places. Where both cubes beside a face
/// have such a loop there, the two loops are neighbours twice over: two strips of surface between
/// the same two vertices. Turning the face in both cubes takes them apart (Wenger 2013, section
/// 3.3.5).
unsigned doubled_faces(unsigned mask);

}  // namespace burnish
