#pragma once

#include "burnish/io/depth_image.h"

namespace burnish {

/// Reads the first image of a TIFF of either byte order, in strips, with one channel of 16-bit
/// unsigned or 32-bit float values, top left first. Errors: bad_file, unsupported, out_of_memory.
Result<DepthImage> decode_tiff(std::span<const std::byte> bytes);

/// An image of floats as an uncompressed little-endian TIFF of one strip; values.size() must be
/// width * height, at most kMaxDepthPixels. Errors: invalid_argument.
Result<std::string> encode_tiff(std::uint32_t width, std::uint32_t height,
                                std::span<const float> values);

}  // namespace burnish
