#pragma once

#include "burnish/io/file_format.h"

namespace burnish {

/// Lines of numbers with blanks, commas or semicolons between them; '#' and lines that begin with
/// "//" are comments; a first line of words or of one count is left out with a note. Three columns
/// are positions; of six the last three are normals where all have length 1 (or 0), colours where
/// all are whole numbers of 0..255 or numbers of 0..1; other columns become channels column_4,
/// column_5, ...
Result<GeometryFile> read_xyz(std::string_view bytes, const std::string& name,
                              const Context& context);
bool recognise_xyz(std::string_view bytes);

}  // namespace burnish
