#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "burnish/base/result.h"

namespace burnish {

/// An image as PCL's grabbers write it.
struct PclzfImage {
  std::uint32_t width = 0, height = 0;
  std::string kind;               ///< "depth16", "rgb24", "yuv422" or "bayer8"
  std::vector<std::byte> values;  ///< depth16: row by row; rgb24: all red, all green, all blue
};

/// Reads a PCLZF: the mark PCLZF, width, height, 16 characters of kind, the sizes packed and
/// unpacked (all uint32, little endian), then LZF. A size claimed is held against the bytes that
/// are there before memory is taken. Errors: bad_file with file and place, unsupported for other
/// kinds.
Result<PclzfImage> decode_pclzf(std::string_view bytes, const std::string& name);

}  // namespace burnish
