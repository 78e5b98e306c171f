#pragma once

#include <cstdint>
#include <string>

#include "burnish/io/cursor.h"

// How the progressive file packs numbers (docs/progressive-file.md).
namespace burnish {

/// The bytes of a number, little endian (as all machines that burnish runs on).
template <class T>
void put_raw(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

/// LEB128: seven bits a byte, the lowest first; all bytes but the last have their highest bit set.
inline void put_number(std::string& bytes, std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) bytes += static_cast<char>(value | 0x80);
  bytes += static_cast<char>(value);
}

/// `value` by its difference from what it is near to: even numbers go up, odd ones down.
inline void put_near(std::string& bytes, std::uint32_t value, std::uint32_t near) {
  const std::int64_t step = static_cast<std::int64_t>(value) - near;
  put_number(bytes, step < 0 ? 2 * static_cast<std::uint64_t>(-step) - 1
                             : 2 * static_cast<std::uint64_t>(step));
}

/// False where the bytes end or the number is `limit` or above.
inline bool read_number(Cursor& cursor, std::uint64_t limit, std::uint64_t& value) {
  value = 0;
  for (int shift = 0; shift < 63; shift += 7) {
    std::uint8_t byte = 0;
    if (!cursor.read(byte)) return false;
    value |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
    if ((byte & 0x80) == 0) return value < limit;
  }
  return false;
}

/// A number below `limit`, of 32 bits.
inline bool read_number(Cursor& cursor, std::uint64_t limit, std::uint32_t& value) {
  std::uint64_t wide = 0;
  if (!read_number(cursor, limit, wide)) return false;
  value = static_cast<std::uint32_t>(wide);
  return true;
}

/// What put_near put; false where it is not below `limit`, which is at most 2^32.
inline bool read_near(Cursor& cursor, std::uint32_t near, std::uint64_t limit,
                      std::uint32_t& value) {
  std::uint64_t code = 0;
  if (!read_number(cursor, std::uint64_t{1} << 34, code)) return false;
  const auto half = static_cast<std::int64_t>(code / 2);
  const std::int64_t wide = code % 2 == 0 ? near + half : near - half - 1;
  if (wide < 0 || wide >= static_cast<std::int64_t>(limit)) return false;
  value = static_cast<std::uint32_t>(wide);
  return true;
}

}  // namespace burnish
