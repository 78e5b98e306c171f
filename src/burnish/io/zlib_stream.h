#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace burnish {

/// Unpacks one zlib stream (RFC 1950) that is all of the input. None where it is damaged, goes on
/// behind its end or gives more than `most` bytes; takes memory as the bytes come, so that a claim
/// costs nothing.
std::optional<std::vector<std::byte>> unpack_zlib(std::span<const std::byte> input,
                                                  std::size_t most);

/// Whether the bytes begin as a zlib stream does.
bool is_zlib(std::span<const std::byte> bytes);

}  // namespace burnish
