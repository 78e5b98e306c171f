#pragma once

#include "burnish/io/file_format.h"

namespace burnish {

/// STL, binary and ascii. A file whose size fits the binary count is binary, whatever it begins
/// with. Corners at the same coordinates (to the bit, but 0 = -0) become one vertex, in the order
/// of the file. Facet normals and attribute bytes are left out; several solids become one mesh.
Result<GeometryFile> read_stl(std::string_view bytes, const std::string& name,
                              const Context& context);
bool recognise_stl(std::string_view bytes);

/// Binary, or ascii. Triangles only; facet normals are computed.
void write_stl(Output& out, const GeometryView& view, const WriteOptions& options);

}  // namespace burnish
