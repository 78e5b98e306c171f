#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace burnish {

/// Unpacks PrimeSense's 16z: a value of 16 bits, then differences of 4 bits (last - next + 6, two
/// in a byte), 8 bits or whole values behind an escape, and runs of equal values. With a `table`
/// (16zT) the stream begins with the count and the list of the values that occur, and packs their
/// indices. None where the stream is damaged or does not give exactly `count` values. 16 bits are
/// little endian, but for escaped values.
std::optional<std::vector<std::uint16_t>> unpack_16z(std::span<const std::byte> input, bool table,
                                                     std::size_t count);

}  // namespace burnish
