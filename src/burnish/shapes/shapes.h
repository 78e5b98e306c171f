#pragma once

#include <span>
#include <string_view>

#include "burnish/base/result.h"
#include "burnish/core/triangle_mesh.h"

// Shapes to scan, to smooth and to test with. All lie around the origin, are oriented outwards (a
// grid upwards) and share their vertices. Sizes are in metres. Counts below the least that makes
// sense are raised to it.
namespace burnish {

/// Which way the cells of a grid are cut in two.
enum class Diagonal {
  rising,       ///< from each cell's lower left corner to its upper right one
  falling,      ///< from each cell's upper left corner to its lower right one
  alternating,  ///< like a chess board: interior vertices have four or eight neighbours
};

/// (columns + 1) x (rows + 1) vertices in the plane z = 0 from the origin along +x and +y, row by
/// row: vertex (column, row) is number row * (columns + 1) + column. Normals point along +z.
TriangleMesh make_grid(int columns, int rows, double spacing = 1,
                       Diagonal diagonal = Diagonal::rising);

/// A closed box of the given size around the origin, each face cut into cells x cells squares.
TriangleMesh make_box(const Vec3d& size = {1, 1, 1}, int cells = 1);

/// An icosahedron (20 triangles) whose triangles were cut in four `subdivisions` times, all
/// vertices on the sphere: 20 * 4^subdivisions triangles of nearly equal size. At most 9
/// subdivisions.
TriangleMesh make_sphere(double radius = 1, int subdivisions = 4);

/// A sphere of longitude and latitude with one vertex at each pole of the z axis:
/// 2 * segments * (rings - 1) triangles. segments >= 3, rings >= 2.
TriangleMesh make_uv_sphere(double radius, int segments, int rings);

/// A torus around the z axis: circles of radius `minor` whose centres lie on one of radius `major`.
/// 2 * segments * sides triangles.
TriangleMesh make_torus(double major = 1, double minor = 0.4, int segments = 64, int sides = 32);

/// A closed cylinder around the z axis from -height / 2 to height / 2; `cells` along the height and
/// from the centre of each lid to its rim.
TriangleMesh make_cylinder(double radius = 1, double height = 2, int segments = 64, int cells = 16);

/// The names that make_shape knows.
std::span<const std::string_view> shape_names();

/// A shape of the size of a thing on a table (about 0.3 m across, standing on z = 0), fine enough
/// to be scanned: "teapot", "sphere", "box", "torus", "cylinder". Errors: invalid_argument that
/// lists the names.
Result<TriangleMesh> make_shape(std::string_view name);

}  // namespace burnish
