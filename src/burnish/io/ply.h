#pragma once

#include "burnish/io/file_format.h"

namespace burnish {

/// PLY 1.0 (Turk 1994): ascii, binary little and big endian; every property type, lists of any
/// types. `vertex` may have any fields (VertexColumns); `face` and `tristrips` are read by their
/// list `vertex_indices` or `vertex_index`; their properties `origin` (uchar, 0 to 2) and `owner`
/// (uint, a vertex) go to every triangle that a polygon is cut into. Other elements, lists and face
/// properties are left out with a note, and so are these two where a value is none. In ascii files
/// every row is a line of its own, as the format asks for.
Result<GeometryFile> read_ply(std::string_view bytes, const std::string& name,
                              const Context& context);
bool recognise_ply(std::string_view bytes);

/// Binary little endian, or ascii. Holds everything; positions are float, or double with a frame.
void write_ply(Output& out, const GeometryView& view, const WriteOptions& options);

}  // namespace burnish
