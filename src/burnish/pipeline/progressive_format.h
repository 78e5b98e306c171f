#pragma once

#include <cstdint>
#include <string_view>

namespace burnish {

/// The first bytes of a progressive file: a byte that is no text, three letters, and line ends that
/// show whether something took the file for text.
inline constexpr std::string_view kProgressiveMagic{
    "\x89"
    "BPM\r\n\x1a\n",
    8};
inline constexpr std::uint8_t kProgressiveVersion = 1;

/// Corners must have 32-bit numbers, and one number is none.
inline constexpr std::uint64_t kMostProgressiveTriangles = 0xffffffffu / 3;
inline constexpr std::uint64_t kMostProgressiveVertices = 0xffffffffu;

}  // namespace burnish
