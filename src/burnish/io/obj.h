#pragma once

#include "burnish/io/file_format.h"

namespace burnish {

/// Wavefront OBJ: `v x y z`, `x y z w` (w is left out), `x y z r g b` or `x y z w r g b`; `vn`
/// where every vertex has one normal; `f` in all its forms (i, i/t, i/t/n, i//n, negative numbers,
/// forward references). A backslash at the end of a line joins the next. Everything else (points,
/// lines, free forms, texture coordinates, groups, materials) is left out with one note that counts
/// it.
Result<GeometryFile> read_obj(std::string_view bytes, const std::string& name,
                              const Context& context);
bool recognise_obj(std::string_view bytes);

/// Colours follow the coordinates as numbers of 0..1; normals are `vn`, one per vertex.
void write_obj(Output& out, const GeometryView& view, const WriteOptions& options);

}  // namespace burnish
