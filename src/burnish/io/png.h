#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "burnish/base/result.h"
#include "burnish/core/attributes.h"

namespace burnish {

/// A picture of `width` x `height` colours, row by row from the top left, as the bytes of an 8-bit
/// PNG with an alpha channel. Sizes from 1 to 65535, width * height == pixels.size(). The same
/// pixels give the same bytes. Errors: invalid_argument, out_of_memory.
Result<std::string> encode_png(std::uint32_t width, std::uint32_t height,
                               std::span<const Color> pixels);

/// The same for an image of 16-bit numbers (grey, big endian inside, as the format says).
Result<std::string> encode_png(std::uint32_t width, std::uint32_t height,
                               std::span<const std::uint16_t> values);

/// Writes encode_png's bytes; the file appears whole or not at all. Errors: also io_failure.
Result<void> write_png(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
                       std::span<const Color> pixels);

/// One channel of 16-bit numbers, row by row from the top left.
struct GreyPng {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint16_t> values;
};

/// Reads a 16-bit grey PNG, interlaced or not. An image of more than `max_pixels`, or of more than
/// its bytes could hold however well compressed, is refused before memory is taken.
/// Errors: bad_file for anything damaged, unsupported for other kinds of PNG, out_of_memory.
Result<GreyPng> decode_grey_png(std::span<const std::byte> bytes, std::size_t max_pixels);

}  // namespace burnish
