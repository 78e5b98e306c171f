#pragma once

#include <cstddef>
#include <span>

namespace burnish {

/// Unpacks LZF (Lehmann's format, as PCD's binary_compressed has it). False where the input is
/// damaged or does not fill `output` exactly; reads and writes within the spans only.
bool unpack_lzf(std::span<const std::byte> input, std::span<std::byte> output);

}  // namespace burnish
