#include "burnish/io/crc32.h"

#include <array>

namespace burnish {
namespace {

using Table = std::array<std::uint32_t, 256>;

/// table[k][b]: what byte b becomes with k bytes of zeros behind it, so that four bytes take one
/// step.
constexpr std::array<Table, 4> make_tables() {
  std::array<Table, 4> tables{};
  for (std::uint32_t b = 0; b < 256; ++b) {
    std::uint32_t rest = b;
    for (int bit = 0; bit < 8; ++bit) rest = (rest >> 1) ^ ((rest & 1) != 0 ? 0xedb88320u : 0);
    tables[0][b] = rest;
  }
  for (std::size_t k = 1; k < 4; ++k) {
    for (std::size_t b = 0; b < 256; ++b) {
      const std::uint32_t before = tables[k - 1][b];
      tables[k][b] = (before >> 8) ^ tables[0][before & 0xff];
    }
  }
  return tables;
}

constexpr std::array<Table, 4> kTables = make_tables();

}  // namespace

void Crc32::add(const void* bytes, std::size_t count) {
  const auto* at = static_cast<const unsigned char*>(bytes);
  std::uint32_t state = state_;
  for (; count >= 4; count -= 4, at += 4) {
    state ^= at[0] | static_cast<std::uint32_t>(at[1]) << 8 |
             static_cast<std::uint32_t>(at[2]) << 16 | static_cast<std::uint32_t>(at[3]) << 24;
    state = kTables[3][state & 0xff] ^ kTables[2][(state >> 8) & 0xff] ^
            kTables[1][(state >> 16) & 0xff] ^ kTables[0][state >> 24];
  }
  for (; count > 0; --count, ++at) state = (state >> 8) ^ kTables[0][(state ^ *at) & 0xff];
  state_ = state;
}

}  // namespace burnish
