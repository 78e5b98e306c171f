#pragma once

#include "burnish/io/file_format.h"

namespace burnish {

/// OFF (Geomview): [ST][C][N]OFF, ascii. Counts may stand on the first line. A vertex line has the
/// coordinates, with N a normal, then a colour of 3 or 4 numbers (bytes, or 0..1 where one has a
/// point in it), with ST two texture coordinates, which are left out, as are the colours of faces.
Result<GeometryFile> read_off(std::string_view bytes, const std::string& name,
                              const Context& context);
bool recognise_off(std::string_view bytes);

/// OFF, NOFF, COFF or CNOFF by what there is; a colour is four bytes.
void write_off(Output& out, const GeometryView& view, const WriteOptions& options);

}  // namespace burnish
