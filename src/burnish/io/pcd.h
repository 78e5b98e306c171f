#pragma once

#include "burnish/io/file_format.h"

namespace burnish {

/// PCD 0.7 and before: ascii, binary and binary_compressed, every type of field. HEIGHT and WIDTH
/// above 1 make an organized cloud. Fields of COUNT n become n channels NAME_0, NAME_1, ... (at
/// most 64, else left out with a note); fields named '_' are padding. VIEWPOINT's position is kept
/// for organized clouds and where it is not the one that everybody writes (0 0 0 1 0 0 0).
Result<GeometryFile> read_pcd(std::string_view bytes, const std::string& name,
                              const Context& context);
bool recognise_pcd(std::string_view bytes);

/// Binary, or ascii. Clouds only; colours as the field rgba.
void write_pcd(Output& out, const GeometryView& view, const WriteOptions& options);

}  // namespace burnish
