#pragma once

#include "burnish/io/depth_image.h"

namespace burnish {

/// Reads a portable grey map of 16-bit values: P5 (big endian) or P2 (text), comments allowed.
/// Errors: bad_file, unsupported for a maxval up to 255.
Result<DepthImage> decode_pgm(std::span<const std::byte> bytes);

}  // namespace burnish
